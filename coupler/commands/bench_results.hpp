// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "coupler/commands/bench_settings.hpp"

namespace polargrain::coupler {

/// Columns of a CSV file of numbers, by name. @throws RunError when it is no such file
std::map<std::string, std::vector<double>> read_columns(const std::filesystem::path& file);

/// One monitor against another, step by step.
struct BenchCurve {
  std::vector<double> x;
  std::vector<double> y;

  /// The value at x between the two places that enclose it, straight; along the curve, so that x may go back:
  /// the first enclosing piece counts. The end value beyond either end.
  [[nodiscard]] double at(double x) const;
};

/// How far a curve is from a reference: at the curve's own places, as far as both go.
struct BenchError {
  double largest = 0.0;  ///< of the difference, over the range of the reference
  double peak = 0.0;     ///< difference of the largest magnitudes, over that of the reference
};
BenchError error_of(const BenchCurve& curve, const BenchCurve& reference);

/// What one run gave.
struct BenchResult {
  BenchSetting setting;
  std::string status;  ///< "done", or why it stopped
  int steps = 0;       ///< committed
  double seconds = 0.0;
  double evaluations = 0.0;  ///< of cells
  double dem_steps = 0.0;
  std::vector<BenchCurve> curves;  ///< one for each y
  std::vector<BenchError> errors;  ///< the same, against the reference
  bool on_front = false;           ///< no other finished run is both faster and closer

  [[nodiscard]] bool done() const { return status == "done"; }
};

/// Compares all with the first, and marks the front (seconds against the largest error of the first y; the
/// reference takes no part).
void compare(std::vector<BenchResult>& results);

}  // namespace polargrain::coupler
