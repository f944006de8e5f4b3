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

TimeTable TimeTable::of_accelerations(const std::vector<Point>& accelerations) {
  TimeTable table(accelerations);
  double speed = 0.0;
  double way = 0.0;
  for (std::size_t i = 0; i < accelerations.size(); ++i) {
    const bool last = i + 1 == accelerations.size();
    const double duration = last ? 1.0 : accelerations[i + 1].time - accelerations[i].time;
    const double acceleration = last ? 0.0 : accelerations[i].value;
    const double jerk = last ? 0.0 : (accelerations[i + 1].value - acceleration) / duration;
    table.points_[i].value = way;
    table.motions_.push_back({speed, acceleration, jerk});
    way += duration * (speed + duration * (acceleration / 2.0 + duration * jerk / 6.0));
    speed += duration * (acceleration + duration * jerk / 2.0);
  }
  return table;
}

double TimeTable::at(double time) const {
  if (time <= points_.front().time) return points_.front().value;
  if (!motions_.empty()) {
    const auto after =
        std::ranges::upper_bound(points_, time, {}, [](const Point& point) { return point.time; });
    const auto i = static_cast<std::size_t>(after - points_.begin() - 1);
    const double since = time - points_[i].time;
    const Motion& motion = motions_[i];
    return points_[i].value +
           since * (motion.speed + since * (motion.acceleration / 2.0 + since * motion.jerk / 6.0));
  }
  if (time >= points_.back().time) return points_.back().value;
  const auto after =
      std::find_if(points_.begin(), points_.end(), [&](const Point& p) { return p.time > time; });
  const auto before = after - 1;
  return before->value +
         (after->value - before->value) * ((time - before->time) / (after->time - before->time));
}

double TimeTable::slope(double time) const {
  if (!motions_.empty()) {
    if (time < points_.front().time) return 0.0;
    const auto after =
        std::ranges::upper_bound(points_, time, {}, [](const Point& point) { return point.time; });
    const auto i = static_cast<std::size_t>(after - points_.begin() - 1);
    const double since = time - points_[i].time;
    return motions_[i].speed + since * (motions_[i].acceleration + since * motions_[i].jerk / 2.0);
  }
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const Point& before = points_[i - 1];
    const Point& after = points_[i];
    if (time >= before.time && time < after.time) {
      return (after.value - before.value) / (after.time - before.time);
    }
  }
  return 0.0;
}

double TimeTable::integral(double from, double to) const {
  double sum = 0.0;
  Point before{from, at(from)};
  const auto go_to = [&](const Point& next) {
    sum += (next.time - before.time) * (before.value + next.value) / 2.0;
    before = next;
  };
  for (const Point& point : points_)
    if (point.time > from && point.time < to) go_to(point);
  go_to({to, at(to)});
  return sum;
}

double TimeTable::share_missed_by_steps(double step, double end) const {
  if (!motions_.empty() || !(step > 0.0) || !(end > 0.0)) return 0.0;
  double missed = 0.0;
  double last_seen = -1.0;
  // A step is exact where the values are straight all along.
  for (const Point& point : points_) {
    const double begin = step * std::floor(point.time / step);
    if (begin == last_seen || begin < 0.0 || begin >= end) continue;
    last_seen = begin;
    missed += std::abs(step * (at(begin) + at(begin + step)) / 2.0 - integral(begin, begin + step));
  }
  if (missed == 0.0) return 0.0;
  TimeTable magnitudes = *this;
  for (Point& point : magnitudes.points_) point.value = std::abs(point.value);
  return missed / magnitudes.integral(0.0, end);
}

bool TimeTable::changes() const {
  return std::ranges::any_of(points_,
                             [&](const Point& point) { return point.value != points_.front().value; });
}

double TimeTable::largest_magnitude() const {
  double largest = 0.0;
  for (const Point& point : points_) largest = std::max(largest, std::abs(point.value));
  return largest;
}

double TimeTable::largest_magnitude_until(double time) const {
  double largest = std::abs(at(time));
  for (const Point& point : points_)
    if (point.time <= time) largest = std::max(largest, std::abs(point.value));
  return largest;
}

double TimeTable::largest_change(double time) const {
  const double now = at(time);
  double largest = 0.0;
  for (const Point& point : points_)
    if (point.time > time) largest = std::max(largest, std::abs(point.value - now));
  return largest;
}

bool TimeTable::operator==(const TimeTable& other) const {
  // Both are straight, or both accelerated, between their points: equal there is equal everywhere.
  if (motions_.empty() != other.motions_.empty()) return false;
  const double scale = std::max(largest_magnitude(), other.largest_magnitude());
  const auto agree = [&](const Point& p) { return std::abs(at(p.time) - other.at(p.time)) <= 1e-12 * scale; };
  return std::ranges::all_of(points_, agree) && std::ranges::all_of(other.points_, agree);
}

}  // namespace polargrain::fem
