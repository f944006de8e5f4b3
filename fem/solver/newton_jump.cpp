// SPDX-License-Identifier: GPL-2.0-or-later
// Newton's iteration at a jump of the stresses (docs/theory/solver.md, when a step is balanced).
#include <algorithm>

#include "common/error.hpp"
#include "fem/solver/newton.hpp"

namespace polargrain::fem {

template <int dim>
Attempt Newton<dim>::pass_jump(StepReport& report) {
  constexpr int kMostAnswers = 3;  // a material that finds its answer too poor may give another one
  if (!best_) return {false, "no iterate that could be committed"};
  Iterate iterate = *best_;
  for (int answers = 0; answers < kMostAnswers; ++answers) {
    evaluate(iterate, report);
    if (const Response<dim>& worst = worst_response(); worst.quality != Quality::good)
      return {false, worst.message, worst.step_factor};
    if (!materials.confirm()) continue;
    report.jump_residual = std::max(report.jump_residual, iterate.residual.force);
    ++report.jumps;
    commit(iterate, Balance::within_tolerance, report);
    jump_ = loads_at(state.time, released_, 1.0) - committed_internal_forces();
    jump_let_go_ = 0.0;
    return {true, ""};
  }
  return {false, "a material does not stand by its answer"};
}

template Attempt Newton<2>::pass_jump(StepReport&);
template Attempt Newton<3>::pass_jump(StepReport&);

}  // namespace polargrain::fem
