// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "app/bench/bench_results.hpp"

namespace polargrain::app {

/// Mean and standard deviation (of n - 1) of some values. No deviation of less than two.
struct Spread {
  int count = 0;
  double mean = 0.0;
  std::optional<double> deviation;
};
Spread spread_of(const std::vector<double>& values);

/// The completed runs with packings of one size: their mean, and how far they are
/// apart, one of each for each y.
struct SizeScatter {
  int grains = 0;
  int packings = 0;
  bool is_reference = false;  ///< no size has more grains
  double seconds = 0.0;       ///< these three: means
  double evaluations = 0.0;
  double dem_steps = 0.0;
  std::vector<Spread> peaks;
  /// Of the mean curve and of the mean peak against those of the size with the most grains.
  std::vector<BenchError> errors;
  /// Standard deviations in the measure of the errors: of the curve where it is largest, over the range of
  /// the reference; of the peak, over the peak of the reference. Zero of less than two packings.
  std::vector<BenchError> deviations;
  Spread inclination;  ///< these three: of the packings with a band
  Spread thickness;
  Spread onset;
};

/// Compares the runs with packings that bench made with the mean of those with the most grains.
/// @returns sizes in the order of their first run; nothing while the most grains have not come to their end
std::vector<SizeScatter> compare_sizes(std::vector<BenchResult>& results);

}  // namespace polargrain::app
