// SPDX-License-Identifier: GPL-2.0-or-later
// Newton's iteration at a jump of the stresses (docs/theory/solver.md, when a step is balanced).
#include <algorithm>

#include "fem/solver/newton.hpp"
#include "fem/solver/why_singular.hpp"

namespace polargrain::fem {

Attempt Newton::pass_jump(const StepGoal& goal, StepReport& report) {
  Predictor predictor = predict(goal);
  Correction change;
  if (!correction(goal, predictor.iterate, state.responses, predictor.right_side, change, report))
    return {false, why_singular(state.responses)};
  const Attempt limited = limit_predictor(goal, predictor.iterate, change, report);
  if (!limited.converged) return limited;
  move(predictor.iterate, change, 1.0, report);
  ++report.iterations;
  const Response& worst = worst_response();
  if (worst.quality != Quality::good) return {false, worst.message, worst.step_factor};
  commit(predictor.iterate, Balance::within_tolerance, report);
  ++report.jumps;
  report.jump_residual = std::max(report.jump_residual, predictor.iterate.residual.force);
  withhold_imbalance();
  return {true, ""};
}

}  // namespace polargrain::fem
