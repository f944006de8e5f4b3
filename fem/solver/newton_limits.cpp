// SPDX-License-Identifier: GPL-2.0-or-later
// How far a correction may go (SolverOptions::largest_strain).
#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>

#include "fem/solver/newton.hpp"

namespace polargrain::fem {
namespace {

/// Norm of the strain without rotations, of which a step may hold as many as it likes.
template <int dim>
double strain_norm(const Increment<dim>& increment, Deformation deformation) {
  using Gradient = typename Cosserat<dim>::Gradient;
  using Place = typename Cosserat<dim>::Place;
  const Gradient& h = increment.displacement_gradient;
  const double linear = (0.5 * (h + h.transpose())).norm();
  if (deformation == Deformation::small) return linear;
  // Rotations come linearised from the solution and exact from the supports: either must not count.
  const Place stretches = Gradient(Gradient::Identity() + h).jacobiSvd().singularValues();
  return std::min(linear, (stretches - Place::Ones()).norm());
}

}  // namespace

template <int dim>
double Newton<dim>::allowed_share(const Eigen::VectorXd& from, const Eigen::VectorXd& change) const {
  const std::vector<Increment<dim>> reached = discretisation.increments(from);
  const std::vector<Increment<dim>> added = discretisation.increments(change);
  double share = 1.0;
  for (std::size_t i = 0; i < added.size(); ++i) {
    const double strain = strain_norm(added[i], problem.deformation);
    const double room = options.largest_strain - strain_norm(reached[i], problem.deformation);
    if (strain > room) share = std::min(share, std::max(room, 0.0) / strain);
  }
  return share;
}

template <int dim>
Attempt Newton<dim>::limit_correction(Iterate& iterate, Correction& change, StepReport& report) const {
  constexpr double kLeastShare = 0.01;
  const double share = allowed_share(iterate.displacement, change.displacement);
  if (share == 1.0) return {true, ""};
  ++report.limited;
  if (share < kLeastShare) {
    return {false, fmt::format("the iteration asks for strains beyond {}", options.largest_strain)};
  }
  change.displacement *= share;
  change.time *= share;
  return {true, ""};
}

template <int dim>
Attempt Newton<dim>::limit_predictor(const StepGoal& goal, Iterate& iterate, Correction& change,
                                     StepReport& report) const {
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(iterate.displacement.size());
  const double share = allowed_share(nothing, iterate.displacement + change.displacement);
  if (share == 1.0) return {true, ""};
  ++report.limited;
  const Attempt cut{
      false,
      fmt::format("the predictor asks for a strain of {:.3g}, more than {}: the tangent is nearly "
                  "singular or the step too long",
                  options.largest_strain / share, options.largest_strain),
      share};
  const Correction drawn_on = last_step_drawn_on(goal, iterate);
  if (drawn_on.displacement.size() == 0 || allowed_share(nothing, drawn_on.displacement) < 1.0) return cut;
  change = {drawn_on.displacement - iterate.displacement, drawn_on.time};
  return {true, ""};
}

template <int dim>
Correction Newton<dim>::last_step_drawn_on(const StepGoal& goal, const Iterate& iterate) const {
  if (state.last_increment.size() == 0) return {};
  Correction drawn_on{state.last_increment, 0.0};
  // The given part of it: the increments of this goal, or so many times their growth with the time.
  Eigen::VectorXd given = goal.controls_time() ? iterate.displacement : constraints.slope(iterate.time);
  for (Eigen::Index entry = 0; entry < given.size(); ++entry) {
    if (constraints.is_free(static_cast<std::size_t>(entry))) given(entry) = 0.0;
  }
  const double square = given.squaredNorm();
  if (square == 0.0) return {};
  if (goal.controls_time()) {
    const double product = given.dot(drawn_on.displacement);
    if (product == 0.0) return {};
    drawn_on.displacement *= square / product;
  } else {
    const double growth = goal.measure.dot(drawn_on.displacement);
    if (!(growth > 0.0)) return {};
    drawn_on.displacement *= goal.amount / growth;
    drawn_on.time = given.dot(drawn_on.displacement) / square;
    given *= drawn_on.time;
  }
  for (Eigen::Index entry = 0; entry < given.size(); ++entry) {
    if (!constraints.is_free(static_cast<std::size_t>(entry))) drawn_on.displacement(entry) = given(entry);
  }
  return drawn_on;
}

template double Newton<2>::allowed_share(const Eigen::VectorXd&, const Eigen::VectorXd&) const;
template Attempt Newton<2>::limit_correction(Iterate&, Correction&, StepReport&) const;
template Attempt Newton<2>::limit_predictor(const StepGoal&, Iterate&, Correction&, StepReport&) const;
template Correction Newton<2>::last_step_drawn_on(const StepGoal&, const Iterate&) const;
template double Newton<3>::allowed_share(const Eigen::VectorXd&, const Eigen::VectorXd&) const;
template Attempt Newton<3>::limit_correction(Iterate&, Correction&, StepReport&) const;
template Attempt Newton<3>::limit_predictor(const StepGoal&, Iterate&, Correction&, StepReport&) const;
template Correction Newton<3>::last_step_drawn_on(const StepGoal&, const Iterate&) const;

}  // namespace polargrain::fem
