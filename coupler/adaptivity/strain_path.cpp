// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/adaptivity/strain_path.hpp"

#include <algorithm>

namespace polargrain::coupler {
namespace {

double distance_from_piece(const Vector7& place, const Vector7& first, const Vector7& last) {
  const Vector7 along = last - first;
  const double squared = along.squaredNorm();
  const double share = squared > 0.0 ? along.dot(place - first) / squared : 0.0;
  return (place - first - std::clamp(share, 0.0, 1.0) * along).norm();
}

/// Adds the numbers of the turning points between the places `first` and `last` (both not included).
void add_between(const std::vector<Vector7>& places, std::size_t first, std::size_t last, double tolerance,
                 std::vector<std::size_t>& found) {
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
  found.push_back(farthest);
  add_between(places, farthest, last, tolerance, found);
}

}  // namespace

std::vector<Increment> turning_points(std::span<const Increment> path, const GrainMeasure& measure,
                                      double tolerance) {
  if (path.empty()) return {};
  std::vector<Vector7> places{Vector7::Zero()};
  for (const Increment& increment : path) places.push_back(measure.place(increment));
  std::vector<std::size_t> found;
  add_between(places, 0, places.size() - 1, tolerance, found);
  found.push_back(path.size());
  std::vector<Increment> turns;
  for (const std::size_t place : found) turns.push_back(path[place - 1]);
  return turns;
}

}  // namespace polargrain::coupler
