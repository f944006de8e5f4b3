// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/calibrate/calibration_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "app/page/page.hpp"

namespace polargrain::app {
namespace {

std::size_t column_in(const ElementResult& result, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(result.columns, name) - result.columns.begin());
}

/// The curves of one test in two columns, and the points of the laboratory.
std::string curves_of(const Calibration& calibration, const std::vector<ElementResult>& best,
                      std::size_t test, const std::string& x, const std::string& y) {
  std::vector<ChartSeries> series;
  for (const ElementCurve& curve : best[test].curves) {
    ChartSeries line;
    line.name = curve.name;
    line.line = true;
    for (const auto& row : curve.rows)
      if (row[column_in(best[test], "stage")] > 0.0)
        line.points.emplace_back(row[column_in(best[test], x)], row[column_in(best[test], y)]);
    series.push_back(std::move(line));
  }
  ChartSeries laboratory;
  laboratory.name = "laboratory";
  laboratory.colour = "#c33";
  for (const TargetPoint& point : calibration.points)
    if (point.test == test && point.where == TargetPoint::Where::along && point.along == x &&
        point.column == y)
      laboratory.points.emplace_back(point.at, point.value);
  series.push_back(std::move(laboratory));
  return fmt::format("<h2>{}: {}</h2>\n", escaped(calibration.test_names[test]), escaped(y)) +
         chart({.title = x}, {.title = y}, series, true);
}

/// The values of a parameter at the best point and at the ends of its 95 % interval.
struct Interval {
  std::string best;
  std::string low;
  std::string high;
  bool is_at_bound;
};

Interval interval_of(const Calibration& calibration, const CalibrationResult& result, std::size_t k) {
  const Parameter& parameter = calibration.parameters[k];
  const double place = parameter.place_of(result.best.values[k]);
  const double low = place - result.half_width[k];
  const double high = place + result.half_width[k];
  return {fmt::format("{:.5g}", result.best.values[k]),
          low > 0.0 ? fmt::format("{:.5g}", parameter.value_at(low)) : "bound",
          high < 1.0 ? fmt::format("{:.5g}", parameter.value_at(high)) : "bound",
          place < 0.01 || place > 0.99};
}

std::string parameters_table(const Calibration& calibration, const CalibrationResult& result) {
  std::vector<TableRow> rows;
  for (std::size_t k = 0; k < calibration.parameters.size(); ++k) {
    const Interval of = interval_of(calibration, result, k);
    rows.push_back(
        {{calibration.parameters[k].name, of.best, of.low, of.high}, of.is_at_bound ? "front" : ""});
  }
  return fmt::format(
             "<p>{} evaluations; {}. Root mean square difference: {:.3g} reading errors, of {} points. Red: at "
             "a bound of the search.</p>\n",
             result.record.size(), escaped(result.end), std::sqrt(result.best.misfit),
             calibration.points.size()) +
         table({"parameter", "best", "95 % from", "to"}, rows);
}

}  // namespace

std::string calibration_summary(const Calibration& calibration, const CalibrationResult& result) {
  std::string text =
      fmt::format("{} evaluations; {}\nroot mean square difference {:.3g} reading errors, of {} points\n\n",
                  result.record.size(), result.end, std::sqrt(result.best.misfit), calibration.points.size());
  text += fmt::format("{:<24} {:>12} {:>12} {:>12}\n", "parameter", "best", "95 % from", "to");
  for (std::size_t k = 0; k < calibration.parameters.size(); ++k) {
    const Interval of = interval_of(calibration, result, k);
    text += fmt::format("{:<24} {:>12} {:>12} {:>12}{}\n", calibration.parameters[k].name, of.best, of.low,
                        of.high, of.is_at_bound ? "   at a bound" : "");
  }
  if (calibration.parameters.size() > 1) {
    text += "\ncorrelations\n";
    for (std::size_t p = 0; p < calibration.parameters.size(); ++p) {
      text += fmt::format("{:<24}", calibration.parameters[p].name);
      for (std::size_t q = 0; q < calibration.parameters.size(); ++q)
        text += fmt::format(" {:>8.3f}",
                            result.correlations(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(q)));
      text += '\n';
    }
    text +=
        "\ndirections, the best known last: half a 95 % interval, as a share of the way between the bounds\n";
    for (std::size_t d = 0; d < result.direction_half_width.size(); ++d) {
      text += fmt::format("{:>10.3g}  ", result.direction_half_width[d]);
      for (std::size_t p = 0; p < calibration.parameters.size(); ++p)
        text += fmt::format(" {:+.2f} {}",
                            result.directions(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(d)),
                            calibration.parameters[p].name);
      text += '\n';
    }
  }
  if (!result.profile.empty())
    text += fmt::format(
        "\nre-optimised profile: least root mean square difference with one parameter held; up to {:.3g} it is within "
        "95 %\n",
        std::sqrt(result.threshold));
  for (const ProfilePoint& point : result.profile) {
    text += fmt::format("{:<24} {:>12.5g} {:>12.4g}{}  ", calibration.parameters[point.parameter].name,
                        point.values[point.parameter], std::sqrt(point.misfit),
                        point.misfit <= result.threshold ? " " : "*");
    for (std::size_t p = 0; p < calibration.parameters.size(); ++p)
      if (p != point.parameter)
        text += fmt::format(" {} {:.4g}", calibration.parameters[p].name, point.values[p]);
    text += '\n';
  }
  return text;
}

std::string calibration_page(const Calibration& calibration, const CalibrationResult& result,
                             const std::vector<ElementResult>& best) {
  std::string body = parameters_table(calibration, result) +
                     details("All figures, as text",
                             "<pre>" + escaped(calibration_summary(calibration, result)) + "</pre>\n");
  std::set<std::tuple<std::size_t, std::string, std::string>> shown;
  for (const TargetPoint& point : calibration.points)
    if (point.where == TargetPoint::Where::along &&
        shown.insert({point.test, point.along, point.column}).second)
      body += curves_of(calibration, best, point.test, point.along, point.column);
  for (std::size_t p = 0; p < calibration.parameters.size() && !result.profile.empty(); ++p) {
    const std::string& name = calibration.parameters[p].name;
    ChartSeries held;
    held.name = "others sought anew";
    held.line = true;
    for (const ProfilePoint& point : result.profile)
      if (point.parameter == p) held.points.emplace_back(point.values[p], std::sqrt(point.misfit));
    ChartSeries limit;
    limit.name = "95 %";
    limit.line = true;
    for (const auto& [value, misfit] : held.points)
      limit.points.emplace_back(value, std::sqrt(result.threshold));
    body +=
        fmt::format("<h2>Profile of {}</h2>\n", escaped(name)) +
        chart({.title = name}, {.title = "root mean square difference, reading errors"}, {held, limit}, true);
  }
  ChartSeries search;
  search.name = "misfit";
  ChartSeries least;
  least.name = "least so far";
  least.line = true;
  for (std::size_t k = 0; k < result.record.size(); ++k) {
    const double misfit = std::sqrt(result.record[k].misfit);
    search.points.emplace_back(static_cast<double>(k + 1), misfit);
    least.points.emplace_back(static_cast<double>(k + 1),
                              least.points.empty() ? misfit : std::min(misfit, least.points.back().second));
  }
  body += "<h2>Convergence</h2>\n" +
          chart({.title = "evaluation"},
                {.title = "root mean square difference, reading errors", .logarithmic = true},
                {search, least}, true);
  return page(calibration.title, body);
}

}  // namespace polargrain::app
