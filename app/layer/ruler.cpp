// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/layer/ruler.hpp"

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <vector>

#include "common/error.hpp"

namespace polargrain::app {
namespace {

/// Places and lengths that the search starts from: shares of the height.
constexpr int kPlaces = 24;
constexpr double kShortest = 0.002;
constexpr double kLongest = 0.4;
constexpr int kLengths = 12;

struct Profile {
  const Eigen::VectorXd& heights;  // from 0 to 1
  const Eigen::VectorXd& displacements;

  /// The rest behind the best line and tanh of this place and length (variable projection).
  [[nodiscard]] double rest(double place, double logarithm_of_length) const {
    Eigen::MatrixXd columns(heights.size(), 3);
    columns.col(0).setOnes();
    columns.col(1) = heights;
    columns.col(2) = ((heights.array() - place) / std::exp(logarithm_of_length)).tanh();
    const Eigen::Vector3d found =
        (columns.transpose() * columns).colPivHouseholderQr().solve(columns.transpose() * displacements);
    return (displacements - columns * found).squaredNorm();
  }
};

double rest_at(const std::vector<double>& values, std::vector<double>&, void* profile) {
  return static_cast<const Profile*>(profile)->rest(values[0], values[1]);
}

}  // namespace

Band band_of(const Eigen::VectorXd& heights, const Eigen::VectorXd& displacements) {
  const double bottom = heights.size() > 0 ? heights.minCoeff() : 0.0;
  const double whole = heights.size() > 0 ? heights.maxCoeff() - bottom : 0.0;
  if (heights.size() < 5 || heights.size() != displacements.size() || !(whole > 0.0) ||
      !displacements.allFinite())
    throw RunError("a band needs the displacements of at least five places at different heights");
  const Eigen::VectorXd scaled = (heights.array() - bottom) / whole;
  const Eigen::VectorXd moved = displacements.array() - displacements.mean();
  Profile profile{scaled, moved};
  std::vector<double> best{0.5, std::log(0.1)};
  double least = std::numeric_limits<double>::infinity();
  for (int p = 0; p < kPlaces; ++p) {
    for (int l = 0; l < kLengths; ++l) {
      const double place = 0.1 + 0.8 * p / (kPlaces - 1);
      const double length =
          std::log(kShortest) + (std::log(kLongest) - std::log(kShortest)) * l / (kLengths - 1);
      const double rest = profile.rest(place, length);
      if (rest < least) {
        least = rest;
        best = {place, length};
      }
    }
  }
  nlopt::opt optimiser(nlopt::LN_SBPLX, 2);
  optimiser.set_min_objective(rest_at, &profile);
  optimiser.set_lower_bounds({0.05, std::log(kShortest)});
  optimiser.set_upper_bounds({0.95, std::log(kLongest)});
  optimiser.set_initial_step(std::vector<double>{0.02, 0.2});
  optimiser.set_xtol_abs(1e-9);
  optimiser.set_maxeval(2000);
  try {
    optimiser.optimize(best, least);
  } catch (const nlopt::roundoff_limited&) {
    // as good as it gets
  }
  const double variance = moved.squaredNorm();
  return {2.0 * std::acosh(std::sqrt(2.0)) * std::exp(best[1]) * whole, bottom + best[0] * whole,
          variance > 0.0 ? 1.0 - least / variance : 0.0};
}

double rotation_in(const Band& band, const Eigen::VectorXd& heights, const Eigen::VectorXd& rotations) {
  double sum = 0.0;
  int count = 0;
  for (Eigen::Index k = 0; k < heights.size(); ++k) {
    if (std::abs(heights[k] - band.place) > 0.5 * band.thickness) continue;
    sum += rotations[k];
    ++count;
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace polargrain::app
