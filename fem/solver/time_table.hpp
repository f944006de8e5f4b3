// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

namespace polargrain::fem {

/// A quantity over the loading time (no physical time: the loading is quasi-static): linear between its
/// points, constant before the first and after the last.
class TimeTable {
 public:
  struct Point {
    double time;
    double value;
  };

  /// @param points at least one, times ascending. @throws RunError otherwise.
  explicit TimeTable(std::vector<Point> points);
  static TimeTable constant(double value) { return TimeTable({{0.0, value}}); }
  /// From 0 at time 0 to `value` at `end`.
  static TimeTable ramp(double value, double end = 1.0) { return TimeTable({{0.0, 0.0}, {end, value}}); }

  [[nodiscard]] double at(double time) const;
  /// Change per time just after `time`.
  [[nodiscard]] double slope(double time) const;
  [[nodiscard]] double largest_magnitude() const;
  /// Whether both have the same values at all times, whatever their points: a value that is reached at time 1 and a table
  /// that says so are equal, to round-off of 1e-12 of the larger magnitude.
  bool operator==(const TimeTable& other) const;

 private:
  std::vector<Point> points_;
};

}  // namespace polargrain::fem
