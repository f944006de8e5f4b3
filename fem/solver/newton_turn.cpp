// SPDX-License-Identifier: GPL-2.0-or-later
// Micro-rotations that follow a large turn, and those that have gone astray.
#include <algorithm>
#include <cmath>

#include "fem/element/dofs.hpp"
#include "fem/material/rotation.hpp"
#include "fem/solver/newton.hpp"

namespace polargrain::fem {

void Newton::turn_predictor(const Iterate& iterate, Correction& change) const {
  // Newton's method itself makes up for less: a fraction of the elastic skew strain of grains.
  constexpr double kLeast = 1e-4;
  if (problem.deformation == Deformation::small || problem.continuum == Continuum::cauchy) return;
  std::vector<Increment> predicted = discretisation.increments(iterate.displacement + change.displacement);
  Eigen::VectorXd left = Eigen::VectorXd::Zero(iterate.displacement.size());
  Eigen::VectorXd volume = left;
  double largest = 0.0;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    const Eigen::Matrix2d& h = predicted[i].displacement_gradient;
    const double behind = rotation_angle(predicted[i]) - 0.5 * (h(1, 0) - h(0, 1));
    largest = std::max(largest, std::abs(behind));
    const auto element = static_cast<std::size_t>(discretisation.element_of_point(i));
    for (const int number : problem.mesh.elements[element].nodes) {
      const auto entry = static_cast<Eigen::Index>(entry_of(static_cast<std::size_t>(number), Dof::w));
      left(entry) += discretisation.point(i).volume * behind;
      volume(entry) += discretisation.point(i).volume;
    }
  }
  if (largest < kLeast) return;
  // Of nodes that share a micro-rotation the mean.
  const Eigen::VectorXd volumes = constraints.restrict_to_free(volume);
  const Eigen::VectorXd sums = constraints.restrict_to_free(left);
  constraints.add_free((volumes.array() > 0.0).select(sums.cwiseQuotient(volumes), 0.0), change.displacement);
}

bool Newton::has_gone_astray() const {
  return std::any_of(increments_.begin(), increments_.end(), [](const Increment& increment) {
    return stretch_and_turn(increment).stretch.strain().head<5>().cwiseAbs().maxCoeff() > 1.0;
  });
}

}  // namespace polargrain::fem
