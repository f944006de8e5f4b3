// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/time_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/error.hpp"

namespace polargrain::fem {

TimeTable::TimeTable(std::vector<Point> points) : points_(std::move(points)) {
  if (points_.empty()) throw RunError("a time table needs at least one point");
  for (std::size_t i = 1; i < points_.size(); ++i) {
    if (!(points_[i].time > points_[i - 1].time)) throw RunError("the times of a time table must ascend");
  }
}

double TimeTable::at(double time) const {
  if (time <= points_.front().time) return points_.front().value;
  if (time >= points_.back().time) return points_.back().value;
  const auto after =
      std::find_if(points_.begin(), points_.end(), [&](const Point& p) { return p.time > time; });
  const auto before = after - 1;
  return before->value +
         (after->value - before->value) * ((time - before->time) / (after->time - before->time));
}

double TimeTable::slope(double time) const {
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const Point& before = points_[i - 1];
    const Point& after = points_[i];
    if (time >= before.time && time < after.time) {
      return (after.value - before.value) / (after.time - before.time);
    }
  }
  return 0.0;
}

double TimeTable::largest_magnitude() const {
  double largest = 0.0;
  for (const Point& point : points_) largest = std::max(largest, std::abs(point.value));
  return largest;
}

bool TimeTable::operator==(const TimeTable& other) const {
  // Both are straight between their points: equal there is equal everywhere.
  const double scale = std::max(largest_magnitude(), other.largest_magnitude());
  const auto agree = [&](const Point& p) { return std::abs(at(p.time) - other.at(p.time)) <= 1e-12 * scale; };
  return std::ranges::all_of(points_, agree) && std::ranges::all_of(other.points_, agree);
}

}  // namespace polargrain::fem
