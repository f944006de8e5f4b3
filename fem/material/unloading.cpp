// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/unloading.hpp"

#include <algorithm>
#include <cmath>

namespace polargrain::fem {
namespace {

constexpr double kSoftest = 0.02;
constexpr double kStiffest = 2.0;
constexpr double kMostContraction = 1.0;

}  // namespace

UnloadingMode::Felt UnloadingMode::felt(const ScaledVector<double>& strain, std::size_t parts) const {
  const Split<double> split(strain);
  std::array<double, 3> factor{1.0, 1.0, 1.0};
  ScaledVector<double> sheared = ScaledVector<double>::Zero();
  Felt felt{split.mean * volumetric_vector<double>(), ScaledMatrix<double>::Zero()};
  for (std::size_t k = 0; k < 3; ++k) {
    if (k < parts) {
      factor[k] = stiffness;
      sheared += split.part[k];
    }
    felt.strain += factor[k] * split.part[k];
  }
  felt.slope = subspace_matrix(factor);
  felt.slope.topLeftCorner<3, 3>().array() += 1.0 / 3.0;
  const double size = sheared.norm();
  if (size > 0.0) {
    felt.strain -= contraction / 3.0 * size * volumetric_vector<double>();
    felt.slope -= contraction / 3.0 * volumetric_vector<double>() * (sheared / size).transpose();
  }
  return felt;
}

std::optional<UnloadingMode> unloading_mode(const SubspaceModuli& moduli, const ScaledVector<double>& strain,
                                            const ScaledVector<double>& stress_increment) {
  const Split<double> strains(strain);
  const Split<double> stresses(stress_increment);
  double work = 0.0;
  double elastic = 0.0;
  double squares = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    work += plain_dot(strains.part[k], stresses.part[k]);
    elastic += moduli.stiffness[k] * strains.part[k].squaredNorm();
    squares += strains.part[k].squaredNorm();
  }
  if (!(elastic > 0.0)) return std::nullopt;
  const double volume = 3.0 * strains.mean - stresses.mean / moduli.bulk;
  return UnloadingMode{std::clamp(work / elastic, kSoftest, kStiffest),
                       std::clamp(volume / std::sqrt(squares), -kMostContraction, kMostContraction)};
}

}  // namespace polargrain::fem
