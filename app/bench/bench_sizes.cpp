// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/bench/bench_sizes.hpp"

#include <algorithm>
#include <cmath>

namespace polargrain::app {
namespace {

using Runs = std::vector<const BenchResult*>;

/// A mean curve, and how far the single ones are from it.
struct MeanCurve {
  BenchCurve curve;
  double largest_deviation = 0.0;
};

/// At the places of the first run: all take the same steps.
MeanCurve mean_curve(const Runs& runs, std::size_t y) {
  MeanCurve mean;
  const BenchCurve& first = runs.front()->curves[y];
  mean.curve.x = first.x;
  mean.curve.time = first.time;
  std::vector<BenchCurve> curves;
  for (const BenchResult* run : runs) curves.push_back(comparable(run->curves[y], first));
  for (const double place : comparable(first, first).x) {
    std::vector<double> values;
    for (const BenchCurve& curve : curves) values.push_back(curve.at(place));
    const Spread spread = spread_of(values);
    mean.curve.y.push_back(spread.mean);
    mean.largest_deviation = std::max(mean.largest_deviation, spread.deviation.value_or(0.0));
  }
  return mean;
}

template <typename Value>
Spread spread_over(const Runs& runs, Value value) {
  std::vector<double> values;
  for (const BenchResult* run : runs)
    if (const std::optional<double> one = value(*run)) values.push_back(*one);
  return spread_of(values);
}

Spread peaks_of(const Runs& runs, std::size_t y) {
  return spread_over(runs, [y](const BenchResult& r) { return std::optional(peak_of(r.curves[y])); });
}

/// The common results of the packings with the most grains.
struct SizeReference {
  std::vector<BenchCurve> curves;
  std::vector<double> peaks;

  explicit SizeReference(const Runs& runs) {
    for (std::size_t y = 0; y < runs.front()->curves.size(); ++y) {
      curves.push_back(mean_curve(runs, y).curve);
      peaks.push_back(peaks_of(runs, y).mean);
    }
  }
  [[nodiscard]] double range(std::size_t y) const {
    const auto [least, most] = std::minmax_element(curves[y].y.begin(), curves[y].y.end());
    return *most - *least;
  }
  /// The mean of the peaks is not the peak of the mean: packings reach theirs at strains of their own.
  [[nodiscard]] BenchError error(std::size_t y, const BenchCurve& curve, double peak) const {
    BenchError error = error_of(curve, curves[y]);
    error.peak = std::abs(peak - peaks[y]) / std::abs(peaks[y]);
    return error;
  }
};

SizeScatter scatter_of(const Runs& runs, const SizeReference& reference) {
  SizeScatter size;
  size.grains = runs.front()->setting.grains;
  size.packings = static_cast<int>(runs.size());
  size.seconds = spread_over(runs, [](const BenchResult& r) { return std::optional(r.seconds); }).mean;
  size.evaluations =
      spread_over(runs, [](const BenchResult& r) { return std::optional(r.evaluations); }).mean;
  size.dem_steps = spread_over(runs, [](const BenchResult& r) { return std::optional(r.dem_steps); }).mean;
  for (std::size_t y = 0; y < reference.curves.size(); ++y) {
    const MeanCurve mean = mean_curve(runs, y);
    const Spread peaks = peaks_of(runs, y);
    size.errors.push_back(reference.error(y, mean.curve, peaks.mean));
    size.deviations.push_back({mean.largest_deviation / reference.range(y),
                               peaks.deviation.value_or(0.0) / std::abs(reference.peaks[y])});
    size.peaks.push_back(peaks);
  }
  size.inclination = spread_over(runs, [](const BenchResult& r) { return r.band.inclination; });
  size.thickness = spread_over(runs, [](const BenchResult& r) { return r.band.thickness; });
  size.onset = spread_over(runs, [](const BenchResult& r) { return r.band.onset; });
  return size;
}

}  // namespace

Spread spread_of(const std::vector<double>& values) {
  Spread spread{static_cast<int>(values.size()), 0.0, {}};
  if (values.empty()) return spread;
  const double count = static_cast<double>(values.size());
  for (const double value : values) spread.mean += value / count;
  if (values.size() < 2) return spread;
  double squares = 0.0;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  spread.deviation = std::sqrt(squares / (count - 1.0));
  return spread;
}

std::vector<SizeScatter> compare_sizes(std::vector<BenchResult>& results) {
  std::vector<int> sizes;
  for (const BenchResult& result : results) {
    const int grains = result.setting.grains;
    if (grains > 0 && std::find(sizes.begin(), sizes.end(), grains) == sizes.end()) sizes.push_back(grains);
  }
  const auto runs_of = [&results](int grains) {
    Runs runs;
    for (const BenchResult& result : results)
      if (result.setting.grains == grains && result.done()) runs.push_back(&result);
    return runs;
  };
  if (sizes.empty()) return {};
  const int most_grains = *std::max_element(sizes.begin(), sizes.end());
  const Runs largest = runs_of(most_grains);
  for (BenchResult& result : results)
    if (result.has_own_packing()) {
      result.errors.clear();
      result.peaks.clear();
    }
  if (largest.empty()) return {};
  const SizeReference reference(largest);
  for (BenchResult& result : results) {
    if (!result.has_own_packing()) continue;
    for (std::size_t y = 0; y < result.curves.size(); ++y) {
      if (result.curves[y].x.empty()) continue;
      result.peaks.push_back(peak_of(result.curves[y]));
      result.errors.push_back(reference.error(y, result.curves[y], result.peaks[y]));
    }
  }
  std::vector<SizeScatter> scatters;
  for (const int grains : sizes) {
    const Runs runs = runs_of(grains);
    if (runs.empty()) continue;
    scatters.push_back(scatter_of(runs, reference));
    scatters.back().is_reference = grains == most_grains;
  }
  return scatters;
}

}  // namespace polargrain::app
