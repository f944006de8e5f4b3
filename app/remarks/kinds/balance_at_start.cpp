// SPDX-License-Identifier: GPL-2.0-or-later
// The imbalance at time zero, and the displacement that step 0 makes of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"
#include "app/remarks/start_of_step_zero.hpp"

namespace polargrain::app {
namespace {

constexpr double kLargeMovement = 0.01;  // of the body
constexpr double kLargeStress = 0.3;     // of the stress at time zero

}  // namespace

void balance_at_start(const Scene& scene, Remarks& remarks) {
  const std::optional<StartOfStepZero> start = start_of_step_zero(scene);
  if (!start) return;
  const double moved = start->largest_displacement / smaller_whole_side(scene);
  if (start->stress_change > kLargeStress && start->has_stress) {
    remarks.push_back(
        {Rank::doubtful, std::max(1.0, start->stress_change / kLargeStress),
         scene.place({"boundary"})
             .fault(fmt::format(
                 "boundary: loads and stress at time zero are out of balance by {:.3g} % of the forces; step 0 moves the body by "
                 "{:.3g} mm for that, and changes its stress by {:.0f} % on average",
                 100.0 * start->out_of_balance, 1e3 * start->largest_displacement,
                 100.0 * start->stress_change)),
         "give all boundaries, the weight and the stress at time zero so that they agree; give later changes "
         "over steps: [[0, FIRST], [1, LAST]]"});
  } else if (moved > kLargeMovement) {
    remarks.push_back(
        {Rank::doubtful, moved / kLargeMovement,
         scene.place({"boundary"})
             .fault(fmt::format(
                 "boundary: step 0 takes up the loads at time zero at once and moves the body by {:.3g} mm, {:.2g} % of "
                 "its smaller side",
                 1e3 * start->largest_displacement, 100.0 * moved)),
         "let the loads grow over steps: [[0, 0], [1, VALUE]], or correct the stiffness or the load"});
  }
}

}  // namespace polargrain::app
