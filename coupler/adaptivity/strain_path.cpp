// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/adaptivity/strain_path.hpp"

#include <algorithm>

namespace polargrain::coupler {
namespace {

double distance_from_piece(const Eigen::Matrix2d& place, const Eigen::Matrix2d& first,
                           const Eigen::Matrix2d& last) {
  const Eigen::Matrix2d along = last - first;
  const double squared = along.squaredNorm();
  const double share = squared > 0.0 ? along.cwiseProduct(place - first).sum() / squared : 0.0;
  return (place - first - std::clamp(share, 0.0, 1.0) * along).norm();
}

/// Adds the turning points between the places `first` and `last` (both not included).
void add_between(const std::vector<Eigen::Matrix2d>& places, std::size_t first, std::size_t last,
                 double tolerance, std::vector<Eigen::Matrix2d>& found) {
  std::size_t farthest = first;
  double largest = tolerance;
  for (std::size_t k = first + 1; k < last; ++k) {
    const double distance = distance_from_piece(places[k], places[first], places[last]);
    if (distance > largest) {
      largest = distance;
      farthest = k;
    }
  }
  if (farthest == first) return;
  add_between(places, first, farthest, tolerance, found);
  found.push_back(places[farthest]);
  add_between(places, farthest, last, tolerance, found);
}

}  // namespace

std::vector<Eigen::Matrix2d> turning_points(std::span<const Eigen::Matrix2d> path, double tolerance) {
  std::vector<Eigen::Matrix2d> found;
  if (path.empty()) return found;
  std::vector<Eigen::Matrix2d> places{Eigen::Matrix2d::Zero()};
  places.insert(places.end(), path.begin(), path.end());
  add_between(places, 0, places.size() - 1, tolerance, found);
  found.push_back(places.back());
  return found;
}

}  // namespace polargrain::coupler
