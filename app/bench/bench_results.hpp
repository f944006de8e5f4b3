// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/bench/bench_settings.hpp"

namespace polargrain::app {

/// One monitor against another, step by step.
struct BenchCurve {
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> time = {};  ///< of the steps

  /// The value at x between the two places that enclose it, straight; along the curve, so that x may go back:
  /// the first enclosing piece counts. The end value beyond either end.
  [[nodiscard]] double at(double x) const;
};

/// Curves as they are compared: over x; over time where x of the reference goes back, so that its values are not found again by x.
/// @returns the curve, with what it is compared along as x
BenchCurve comparable(const BenchCurve& curve, const BenchCurve& reference);

/// The value of largest magnitude. @param curve not empty
double peak_of(const BenchCurve& curve);
/// The value farthest to the side that a peak of another curve is on: where two curves go both ways, peaks on the same
/// side are compared. @param curve not empty
double peak_like(const BenchCurve& curve, double peak);

/// How far a curve is from a reference (comparable): at the curve's own places, as far as both go, and where that ends.
struct BenchError {
  double largest = 0.0;  ///< of the difference, over the range of the reference
  double peak =
      0.0;  ///< difference of the peaks on the reference's side (peak_like), over that of the reference
};
BenchError error_of(const BenchCurve& curve, const BenchCurve& reference);

/// The shear band of a run, as `polargrain band` measures it.
struct BenchBand {
  std::string none;                   ///< why there is no band; empty with one, and without a search
  std::optional<double> inclination;  ///< magnitude, against the x axis: mirror images are alike; degrees
  std::optional<double> thickness;    ///< m
  std::optional<double> onset;        ///< axial strain
};

/// The outcome of one run.
struct BenchResult {
  BenchSetting setting;
  std::string status;  ///< "done", or why it stopped
  int steps = 0;       ///< committed
  double seconds = 0.0;
  double evaluations = 0.0;  ///< of cells
  double dem_steps = 0.0;
  std::vector<BenchCurve> curves;  ///< one for each y
  BenchBand band;
  std::vector<BenchError> errors;  ///< one for each y; empty while there is nothing to compare with
  std::vector<double> peaks;       ///< of each y on the side of that of the reference; empty as `errors`
  bool on_front = false;           ///< no other finished run is both faster and closer

  [[nodiscard]] bool done() const { return status == "done"; }
  [[nodiscard]] bool has_own_packing() const { return setting.grains > 0; }
};

/// Compares all but the packings that bench made (bench_sizes.hpp) with the first.
void compare(std::vector<BenchResult>& results);

/// Marks the front: seconds against the largest error of the first y. The reference takes no part, nor do
/// packings that bench made: they have another reference, and which of them is close is chance.
void mark_front(std::vector<BenchResult>& results);

}  // namespace polargrain::app
