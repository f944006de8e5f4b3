// SPDX-License-Identifier: GPL-2.0-or-later
#include "band/local_strain.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

namespace polargrain::band {
namespace {

/// Points sorted into square boxes, so that neighbours are found without looking at all pairs.
class Boxes {
 public:
  Boxes(const std::vector<Eigen::Vector2d>& positions, double side) : side_(side) {
    for (std::size_t k = 0; k < positions.size(); ++k)
      boxes_[key(index(positions[k].x()), index(positions[k].y()))].push_back(k);
  }
  /// Calls visit(k) for every point k that may be nearer than the side of a box.
  template <class Visit>
  void near(const Eigen::Vector2d& position, Visit visit) const {
    for (std::int64_t i = index(position.x()) - 1; i <= index(position.x()) + 1; ++i)
      for (std::int64_t j = index(position.y()) - 1; j <= index(position.y()) + 1; ++j)
        if (const auto box = boxes_.find(key(i, j)); box != boxes_.end())
          for (const std::size_t k : box->second) visit(k);
  }

 private:
  [[nodiscard]] std::int64_t index(double x) const {
    return static_cast<std::int64_t>(std::clamp(std::floor(x / side_), -kFarthest, kFarthest));
  }
  static std::int64_t key(std::int64_t i, std::int64_t j) { return i * 2'000'003 + j; }
  static constexpr double kFarthest = 1e12;  ///< a key of a box farther away would have more than 64 bits

  double side_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> boxes_;
};

}  // namespace

double mean_area(const std::vector<Eigen::Vector2d>& positions) {
  Eigen::Vector2d low = positions.front();
  Eigen::Vector2d high = low;
  for (const Eigen::Vector2d& position : positions) {
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  return (high - low).prod() / static_cast<double>(positions.size());
}

std::vector<Eigen::Matrix2d> displacement_gradients(const std::vector<Eigen::Vector2d>& positions,
                                                    const std::vector<Eigen::Vector2d>& displacements,
                                                    double radius) {
  const Boxes boxes(positions, radius);
  std::vector<Eigen::Matrix2d> gradients;
  gradients.reserve(positions.size());
  for (const Eigen::Vector2d& here : positions) {
    // Normal equations of u = a + H (x - here), in units of the radius.
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    Eigen::Matrix<double, 3, 2> loads = Eigen::Matrix<double, 3, 2>::Zero();
    boxes.near(here, [&](std::size_t k) {
      const Eigen::Vector2d apart = (positions[k] - here) / radius;
      const double inside = 1.0 - apart.squaredNorm();
      if (inside <= 0.0) return;
      const Eigen::Vector3d basis(1.0, apart.x(), apart.y());
      moments += inside * inside * basis * basis.transpose();
      loads += inside * inside * basis * displacements[k].transpose();
    });
    const Eigen::FullPivLU<Eigen::Matrix3d> solver(moments);
    Eigen::Matrix2d gradient = Eigen::Matrix2d::Constant(std::numeric_limits<double>::quiet_NaN());
    // Fewer than three points that span the plane leave a pivot at round-off.
    if (std::abs(solver.matrixLU()(2, 2)) > 1e-6 * solver.maxPivot())
      gradient = (solver.solve(loads).bottomRows<2>() / radius).transpose();
    gradients.push_back(gradient);
  }
  return gradients;
}

}  // namespace polargrain::band
