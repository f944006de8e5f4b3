// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/shortest_pulse.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace polargrain::app {
namespace {

using Point = fem::TimeTable::Point;

/// First and last values, and between them those where a swing of `least` or more ends and one the other way begins.
std::vector<std::size_t> turns_of(const std::vector<Point>& values, double least) {
  std::vector<std::size_t> turns{0};
  std::size_t low = 0;
  std::size_t high = 0;
  int way = 0;  // 1: up, -1: down, 0: not known yet
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i].value < values[low].value) low = i;
    if (values[i].value > values[high].value) high = i;
    const bool falls = way >= 0 && values[high].value - values[i].value >= least;
    const bool rises = way <= 0 && values[i].value - values[low].value >= least;
    if (falls && high != turns.back()) turns.push_back(high);
    if (rises && low != turns.back()) turns.push_back(low);
    if (!falls && !rises) continue;
    way = falls ? -1 : 1;
    low = high = i;
  }
  if (way != 0) turns.push_back(way > 0 ? high : low);
  return turns;
}

/// The time at which values come to a level, from a turn to another one before or behind it.
double time_at_level(const std::vector<Point>& values, std::size_t from, std::size_t to, double level) {
  const bool is_above = values[from].value > level;
  std::size_t i = from;
  while (i != to) {
    const std::size_t next = to > from ? i + 1 : i - 1;
    if ((values[next].value > level) != is_above) {
      const double share = (level - values[i].value) / (values[next].value - values[i].value);
      return values[i].time + share * (values[next].time - values[i].time);
    }
    i = next;
  }
  return values[to].time;
}

}  // namespace

double shortest_pulse(const std::vector<Point>& values) {
  constexpr double kLargeSwing = 0.45;  // of the range: one swing of a sine from rest has half
  if (values.empty()) return 0.0;
  const auto [least, most] = std::ranges::minmax(values, {}, &Point::value);
  const double range = most.value - least.value;
  if (!(range > 0.0)) return 0.0;
  const std::vector<std::size_t> turns = turns_of(values, kLargeSwing * range);
  double shortest = HUGE_VAL;
  for (std::size_t k = 1; k + 1 < turns.size(); ++k) {
    const double peak = values[turns[k]].value;
    const double before = values[turns[k - 1]].value;
    const double behind = values[turns[k + 1]].value;
    // The first value is no turn.
    if (std::min(std::abs(peak - before), std::abs(peak - behind)) < kLargeSwing * range) continue;
    shortest =
        std::min(shortest, 2.0 * (time_at_level(values, turns[k], turns[k + 1], 0.5 * (peak + behind)) -
                                  time_at_level(values, turns[k], turns[k - 1], 0.5 * (peak + before))));
  }
  return std::isfinite(shortest) ? shortest : 0.0;
}

std::vector<Point> values_until(const fem::TimeTable& load, double end) {
  std::vector<Point> values{{0.0, load.at(0.0)}};
  for (const Point& point : load.points())
    if (point.time > 0.0 && point.time < end) values.push_back(point);
  values.push_back({end, load.at(end)});
  return values;
}

std::vector<Point> speeds_until(const fem::TimeTable& displacement, double end) {
  std::vector<Point> speeds{{0.0, 0.0}};  // from rest
  for (const Point& point : displacement.points()) {
    if (point.time < 0.0 || point.time >= end) continue;
    // A straight piece has one speed up to its end.
    if (!displacement.is_accelerated()) speeds.push_back({point.time, speeds.back().value});
    speeds.push_back({point.time, displacement.slope(point.time)});
  }
  speeds.push_back({end, displacement.is_accelerated() ? displacement.slope(end) : speeds.back().value});
  return speeds;
}

}  // namespace polargrain::app
