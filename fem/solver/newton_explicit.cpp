// SPDX-License-Identifier: GPL-2.0-or-later
// A step that goes where it is told: the explicit steps of Solver.
#include "fem/solver/newton.hpp"

namespace polargrain::fem {

template <int dim>
Attempt Newton<dim>::go_on(double time, double released, const Eigen::VectorXd& moved, StepReport& report) {
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
  if (const Response<dim>& worst = worst_response(); worst.quality == Quality::failed)
    return {false, (inverted_.empty() ? "a material failed: " : "") + worst.message, worst.step_factor};
  if (!std::isfinite(iterate.residual.force + iterate.residual.moment))
    return {false, "the forces are not finite"};
  commit(iterate, Balance::within_tolerance, report);
  return {true, ""};
}

template <int dim>
Eigen::VectorXd Newton<dim>::unbalanced() const {
  return loads_at(state.time, released_, jump_let_go_) - discretisation.internal_forces(state.responses);
}

template <int dim>
Eigen::VectorXd Newton<dim>::stable_masses(double safety) {
  move_to_committed();
  return nodal_masses(discretisation, linearised(state.responses), safety);
}


template Attempt Newton<2>::go_on(double, double, const Eigen::VectorXd&, StepReport&);
template Eigen::VectorXd Newton<2>::unbalanced() const;
template Eigen::VectorXd Newton<2>::stable_masses(double);
template Attempt Newton<3>::go_on(double, double, const Eigen::VectorXd&, StepReport&);
template Eigen::VectorXd Newton<3>::unbalanced() const;
template Eigen::VectorXd Newton<3>::stable_masses(double);

}  // namespace polargrain::fem
