// SPDX-License-Identifier: GPL-2.0-or-later
// A run that takes days.
#include <fmt/format.h>

#include "app/remarks/kinds.hpp"
#include "app/remarks/sizes.hpp"

namespace polargrain::app {

void cost(const Scene& scene, Remarks& remarks) {
  constexpr double kLong = 7.0 * 86400.0;  // seconds of one core
  const Expectation expected = expectation_of(scene);
  if (expected.core_seconds <= kLong) return;
  remarks.push_back(
      {Rank::costly, expected.core_seconds / kLong,
       scene.place({"mesh"}).fault(fmt::format("mesh: {} are expected, {:.0f} days of one core",
                                               expected.work(), expected.core_seconds / 86400.0)),
       "'model: informed' asks each cell once a step, 'adaptive' only some of them; or fewer points, steps and grains"});
}

}  // namespace polargrain::app
