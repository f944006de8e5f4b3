// SPDX-License-Identifier: GPL-2.0-or-later
// How far a correction may go (SolverOptions::largest_strain).
#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>

#include "fem/solver/newton.hpp"

namespace polargrain::fem {
namespace {

/// Norm of the strain without rotations, of which a step may hold as many as it likes.
double strain_norm(const Increment& increment, Deformation deformation) {
  const Eigen::Matrix2d& h = increment.displacement_gradient;
  const double linear = (0.5 * (h + h.transpose())).norm();
  if (deformation == Deformation::small) return linear;
  // Rotations come linearised from the solution and exact from the supports: either must not count.
  const Eigen::Vector2d stretches = (Eigen::Matrix2d::Identity() + h).jacobiSvd().singularValues();
  return std::min(linear, (stretches - Eigen::Vector2d::Ones()).norm());
}

}  // namespace

double Newton::allowed_share(const Eigen::VectorXd& from, const Eigen::VectorXd& change) const {
  const std::vector<Increment> reached = discretisation.increments(from);
  const std::vector<Increment> added = discretisation.increments(change);
  double share = 1.0;
  for (std::size_t i = 0; i < added.size(); ++i) {
    const double strain = strain_norm(added[i], problem.deformation);
    const double room = options.largest_strain - strain_norm(reached[i], problem.deformation);
    if (strain > room) share = std::min(share, std::max(room, 0.0) / strain);
  }
  return share;
}

Attempt Newton::limit_correction(Iterate& iterate, Correction& change, StepReport& report) const {
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

Attempt Newton::limit_predictor(const StepGoal& goal, Iterate& iterate, Correction& change,
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
  if (!goal.controls_time() || state.last_increment.size() == 0) return cut;
  // The last step drawn on, as far as the given entries say.
  Eigen::VectorXd drawn_on = state.last_increment;
  double product = 0.0;
  double square = 0.0;
  for (Eigen::Index entry = 0; entry < drawn_on.size(); ++entry) {
    if (constraints.is_free(static_cast<std::size_t>(entry))) continue;
    product += iterate.displacement(entry) * drawn_on(entry);
    square += drawn_on(entry) * drawn_on(entry);
  }
  if (square == 0.0) return cut;
  drawn_on *= product / square;
  for (Eigen::Index entry = 0; entry < drawn_on.size(); ++entry) {
    if (!constraints.is_free(static_cast<std::size_t>(entry))) drawn_on(entry) = iterate.displacement(entry);
  }
  if (allowed_share(nothing, drawn_on) < 1.0) return cut;
  change.displacement = drawn_on - iterate.displacement;
  return {true, ""};
}

}  // namespace polargrain::fem
