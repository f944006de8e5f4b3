// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

namespace polargrain::fem {

/// A quantity over the loading time (no physical time but in dynamics): linear between its points, constant before the
/// first and after the last; the displacement of a body that is accelerated is cubic between them.
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

  /// The displacement, m, of a body at rest before the first point, by its acceleration, m/s2, which is straight between the
  /// points and zero outside of them: behind the last point it keeps its speed.
  static TimeTable of_accelerations(const std::vector<Point>& accelerations);

  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] double at(double time) const;
  /// Change per time just after `time`.
  [[nodiscard]] double slope(double time) const;
  [[nodiscard]] double largest_magnitude() const;
  [[nodiscard]] double largest_magnitude_until(double time) const;
  /// Largest magnitude of the change from the value at `time` to any that comes later.
  [[nodiscard]] double largest_change(double time) const;
  /// Whether it has more than one value.
  [[nodiscard]] bool changes() const;
  /// Integral over the time from `from` to `to`; not of_accelerations.
  [[nodiscard]] double integral(double from, double to) const;
  /// How far equal steps that take the values at their ends are off the integral up to `end`: the differences of all steps,
  /// over the integral, all as magnitudes. Large where the values go there and back within a step; 0 for of_accelerations.
  [[nodiscard]] double share_missed_by_steps(double step, double end) const;
  /// Whether it is of_accelerations.
  [[nodiscard]] bool is_accelerated() const { return !motions_.empty(); }
  /// Whether both have the same values at all times, whatever their points: a value that is reached at time 1 and a table
  /// that says so are equal, to round-off of 1e-12 of the larger magnitude.
  bool operator==(const TimeTable& other) const;

 private:
  /// Of an accelerated body at a point.
  struct Motion {
    double speed;
    double acceleration;
    double jerk;  ///< from there to the next point
  };
  std::vector<Point> points_;
  std::vector<Motion> motions_;  ///< one a point; empty: straight between the points
};

}  // namespace polargrain::fem
