// SPDX-License-Identifier: GPL-2.0-or-later
// A step that goes where it is told: the explicit steps of Solver.
#include "fem/solver/newton.hpp"

namespace polargrain::fem {

Attempt Newton::go_on(double time, double released, const Eigen::VectorXd& moved, StepReport& report) {
  move_to_committed();
  internal_before_ = discretisation.internal_forces(state.responses);
  loads_before_ = loads_at(state.time, released_, jump_let_go_);
  Iterate iterate = start_of({.time = time, .measure = {}, .released = released});
  constraints.add_free(moved, iterate.displacement);
  if (allowed_share(Eigen::VectorXd::Zero(iterate.displacement.size()), iterate.displacement) < 1.0)
    return {
        false,
        "a point would be strained by more than `largest_strain` in one explicit step: the nodes move too fast"};
  evaluate(iterate, report);
  ++report.iterations;
  if (const Response& worst = worst_response(); worst.quality == Quality::failed)
    return {false, (inverted_.empty() ? "a material failed: " : "") + worst.message, worst.step_factor};
  if (!std::isfinite(iterate.residual.force + iterate.residual.moment))
    return {false, "the forces are not finite"};
  commit(iterate, Balance::within_tolerance, report);
  return {true, ""};
}

Eigen::VectorXd Newton::unbalanced() const {
  return loads_at(state.time, released_, jump_let_go_) - discretisation.internal_forces(state.responses);
}

Eigen::VectorXd Newton::stable_masses(double safety) {
  move_to_committed();
  return nodal_masses(discretisation, linearised(state.responses), safety);
}

}  // namespace polargrain::fem
