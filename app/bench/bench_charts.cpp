// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/bench/bench_charts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/page/page.hpp"

namespace polargrain::app {
namespace {

/// The least values that a logarithmic axis shows.
constexpr double kLeastError = 1e-6;
constexpr double kLeastSeconds = 1e-3;

constexpr const char* kScatterColour = "#6a4";

std::string name_of(const BenchSetting& setting) {
  return setting.label.empty() ? setting.group : setting.label;
}

/// The mark of a run.
ChartSeries mark_of(const BenchResult& result, std::size_t y, const std::vector<SizeScatter>& sizes) {
  ChartSeries mark;
  mark.name = name_of(result.setting);
  mark.points = {{std::max(kLeastSeconds, result.seconds), std::max(kLeastError, result.errors[y].largest)}};
  mark.square = result.has_own_packing();
  mark.is_named = true;
  if (mark.square && sizes.size() > 1) mark.size = 3.5;
  for (const SizeScatter& size : sizes)  // their mean bears the name
    if (size.grains == result.setting.grains && size.packings > 1) mark.is_named = false;
  mark.colour = !result.done() ? "#fff" : result.on_front ? "#c33" : mark.square ? "#bd9" : "#8ac";
  return mark;
}

ChartSeries mean_of(const SizeScatter& size, std::size_t y) {
  ChartSeries mark;
  mark.name = fmt::format("{} grains, mean of {}", size.grains, size.packings);
  mark.points = {{std::max(kLeastSeconds, size.seconds), std::max(kLeastError, size.errors[y].largest)}};
  mark.square = true;
  mark.is_named = true;
  mark.size = 6.0;
  mark.colour = kScatterColour;
  return mark;
}

/// A line across the chart where the scatter of a size lies.
ChartSeries scatter_of(const SizeScatter& size, std::size_t y, double from, double to) {
  const double height = std::max(kLeastError, size.deviations[y].largest);
  ChartSeries line;
  line.name = fmt::format("scatter of {} grains", size.grains);
  line.points = {{to, height}, {from, height}};
  line.line = true;
  line.dashed = true;
  line.is_named = true;
  line.colour = kScatterColour;
  return line;
}

}  // namespace

std::string error_chart(std::size_t y, const std::vector<BenchResult>& results,
                        const std::vector<SizeScatter>& sizes) {
  std::vector<ChartSeries> series;
  for (const BenchResult& result : results)
    if (&result != &results.front() && y < result.errors.size()) series.push_back(mark_of(result, y, sizes));
  for (const SizeScatter& size : sizes)
    if (!size.is_reference && size.packings > 1) series.push_back(mean_of(size, y));
  if (series.empty()) return "";
  const auto seconds = [](const ChartSeries& mark) { return mark.points.front().first; };
  const auto [first, last] = std::ranges::minmax(series, {}, seconds);
  const double from = seconds(first);
  const double to = seconds(last);
  for (const SizeScatter& size : sizes)
    if (size.deviations[y].largest > 0.0) series.push_back(scatter_of(size, y, from, to));
  return chart({.title = "wall time, s", .logarithmic = true},
               {.title = "largest error", .logarithmic = true, .percent = true}, series, false);
}

std::string curve_chart(std::size_t y, const BenchAxes& axes, const std::vector<BenchResult>& results) {
  std::vector<ChartSeries> series;
  for (const BenchResult& result : results) {
    if (y >= result.curves.size() || result.curves[y].x.empty()) continue;
    ChartSeries line;
    line.name = name_of(result.setting);
    const BenchCurve& curve = result.curves[y];
    for (std::size_t k = 0; k < curve.x.size(); ++k) line.points.emplace_back(curve.x[k], curve.y[k]);
    line.line = true;
    if (&result == &results.front()) line.colour = "text";
    series.push_back(std::move(line));
  }
  if (series.empty()) return "";
  return chart({.title = axes.x, .unit = axes.x_unit},
               {.title = axes.y[y], .unit = y < axes.y_units.size() ? axes.y_units[y] : ""}, series, true);
}

}  // namespace polargrain::app
