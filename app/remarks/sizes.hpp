// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "app/remarks/scene.hpp"

namespace polargrain::app {

/// The expected cost of a run, to a factor of three or so.
struct Expectation {
  double evaluations = 0.0;       ///< of cells
  double dem_steps_of_box = 0.0;  ///< of boxes that stay with their workers in explicit steps
  double core_seconds = 0.0;
  double bytes_of_boxes = 0.0;  ///< with all their workers and the coordinator

  [[nodiscard]] std::string work() const;  ///< in words; without cells it is empty
};

/// From the points, steps and grains of a case: as long as cells of cases/biaxial take (docs/performance.md).
Expectation expectation_of(const Scene& scene);

/// The sizes that decide the worth of a result, a line each: body, elements over lc, lc over the grains, the largest movement
/// over the body, strain of a step over the elastic strain of the packing, grains of a cell, motions of a base, cells and time to
/// be expected.
std::string sizes_text(const Scene& scene);

}  // namespace polargrain::app
