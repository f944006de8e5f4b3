// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "coupler/case/case.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::app {

/// Goes over to the stage of construction that begins with a step of the plan, where one does.
template <int dim>
void begin_stage_of(const coupler::Case& the_case, int step, fem::Solver<dim>& solver) {
  const coupler::CaseStage* const stage = the_case.stage_of(step);
  if (stage == nullptr || stage->first_step != step) return;
  if (stage->number != solver.state().stage) solver.begin_stage(stage->number);
  if (stage->resets_displacements) solver.reset_displacements();
}

/// Takes a step of the plan by Newton's method, the first one is 1. Its stage has begun.
template <int dim>
fem::StepReport take_balanced_step(const coupler::StepTarget& target, fem::Solver<dim>& solver) {
  switch (target.control) {
    case coupler::StepTarget::Control::measure:
      return solver.advance_measure(target.measure, target.amount, target.released);
    case coupler::StepTarget::Control::arc_length:
      return solver.advance_arc_length(target.amount, target.released);
    case coupler::StepTarget::Control::time:
      break;
  }
  return solver.advance(target.amount, target.released);
}

}  // namespace polargrain::app
