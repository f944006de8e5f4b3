// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/calibrate/doubts_of_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace polargrain::app {
namespace {

constexpr double kOtherOrder =
    30.0;  // parameters of contacts change curves less; per cent are a hundred times shares
constexpr double kOpposite = -0.5;   // cosine between the values of both
constexpr double kBeginning = 0.02;  // of the test

/// The points of one curve of the laboratory, and the tests' values there.
struct Pair {
  std::vector<double> laboratory;
  std::vector<double> tests;
  double farthest = 0.0;  ///< place of a point
};

double largest(const std::vector<double>& values) {
  double found = 0.0;
  for (const double value : values) found = std::max(found, std::abs(value));
  return found;
}

/// Cosine of the angle between both, as vectors.
double cosine(const Pair& pair) {
  double product = 0.0, one = 0.0, other = 0.0;
  for (std::size_t k = 0; k < pair.tests.size(); ++k) {
    product += pair.laboratory[k] * pair.tests[k];
    one += pair.laboratory[k] * pair.laboratory[k];
    other += pair.tests[k] * pair.tests[k];
  }
  return one > 0.0 && other > 0.0 ? product / std::sqrt(one * other) : 0.0;
}

/// Largest magnitude of a column over all packings.
double reach_of(const std::string& name, const std::vector<std::string>& columns,
                const std::vector<std::vector<std::vector<double>>>& curves) {
  const auto column = static_cast<std::size_t>(std::ranges::find(columns, name) - columns.begin());
  double reach = 0.0;
  for (const auto& rows : curves)
    for (const auto& row : rows) reach = std::max(reach, std::abs(row[column]));
  return reach;
}

/// Whether a column still grows at the end of the test, on the side of a largest value: that is the one of the last row.
bool is_rising(const TargetPoint& point, const std::vector<std::string>& columns,
               std::vector<std::vector<double>> rows) {
  const int stage = point.stage;
  const auto column = static_cast<std::size_t>(std::ranges::find(columns, point.column) - columns.begin());
  const auto of_stage = static_cast<std::size_t>(std::ranges::find(columns, "stage") - columns.begin());
  if (stage > 0) std::erase_if(rows, [&](const auto& row) { return row[of_stage] != stage; });
  if (column >= columns.size() || rows.size() < 2) return false;
  const auto size_of = [&](const auto& row) { return point.sign_of_largest() * row[column]; };
  return std::ranges::all_of(
      rows, [&](const auto& row) { return &row == &rows.back() || size_of(row) < size_of(rows.back()); });
}

}  // namespace

std::vector<std::string> doubts_of_curves(
    const Calibration& calibration, const std::vector<std::vector<std::string>>& columns,
    const std::vector<std::vector<std::vector<std::vector<double>>>>& curves) {
  std::map<std::tuple<std::size_t, std::string, std::string>, Pair> pairs;
  for (const TargetPoint& point : calibration.points) {
    if (point.where != TargetPoint::Where::along) continue;
    Pair& pair = pairs[{point.test, point.column, point.along}];
    pair.farthest = std::max(pair.farthest, std::abs(point.at));
    const std::optional<double> value = value_of(point, columns[point.test], curves[point.test].front());
    if (!value || !std::isfinite(*value)) continue;
    pair.laboratory.push_back(point.value);
    pair.tests.push_back(*value);
  }
  std::vector<std::string> doubts;
  for (const TargetPoint& point : calibration.points)
    if (point.where == TargetPoint::Where::largest &&
        is_rising(point, columns[point.test], curves[point.test].front()))
      doubts.push_back(fmt::format(
          "{} of test '{}': its largest value is that of the last row, so no peak was reached: let the test go on, or write "
          "'last' for 'largest'",
          point.column, calibration.test_names[point.test]));
  for (const auto& [which, pair] : pairs) {
    const auto& [test, column, along] = which;
    const std::string of = fmt::format("{} of test '{}'", column, calibration.test_names[test]);
    const double here = largest(pair.laboratory);
    const double there = largest(pair.tests);
    if (here > 0.0 && there > 0.0 && (here > kOtherOrder * there || there > kOtherOrder * here))
      doubts.push_back(fmt::format(
          "{}: the laboratory has up to {:.3g}, and the test with the values of 'start' up to {:.3g}: "
          "check the unit of the table, and give 'factor' of the target (1e3 for kPa, 0.01 for per cent)",
          of, here, there));
    else if (pair.tests.size() > 1 && cosine(pair) < kOpposite)
      doubts.push_back(fmt::format(
          "{}: the laboratory and the test have opposite signs: give 'factor: -1' of the target where its "
          "table counts compression as positive",
          of));
    const double reach = reach_of(along, columns[test], curves[test]);
    if (pair.farthest > 0.0 && pair.farthest < kBeginning * reach)
      doubts.push_back(fmt::format(
          "{}: the points of the laboratory end at {} {:.3g}, and the test goes to {:.3g}: check 'factor_along' of the "
          "target, or let the test end earlier",
          of, along, pair.farthest, reach));
  }
  return doubts;
}

}  // namespace polargrain::app
