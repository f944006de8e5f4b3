// SPDX-License-Identifier: GPL-2.0-or-later
// Micro-rotations that follow a large turn.
#include <algorithm>
#include <cmath>

#include "fem/element/dofs.hpp"
#include "fem/material/polar_decomposition.hpp"
#include "fem/material/rotation.hpp"
#include "fem/solver/newton.hpp"

namespace polargrain::fem {

namespace {

/// By how much a linear rotation stays behind the turn of an increment, about each axis of rotation, rad.
template <int dim>
typename Cosserat<dim>::Rotation left_behind(const Increment<dim>& increment) {
  typename Cosserat<dim>::Rotation behind;
  const auto& h = increment.displacement_gradient;
  if constexpr (dim == 2) {
    behind(0) = rotation_angle(increment) - 0.5 * (h(1, 0) - h(0, 1));
  } else {
    behind = rotation_vector(increment) - axial(h);
  }
  return behind;
}

}  // namespace

template <int dim>
void Newton<dim>::turn_predictor(const Iterate& iterate, Correction& change) const {
  // Newton's method itself makes up for less: a fraction of the elastic skew strain of grains.
  constexpr double kLeast = 1e-4;
  if (problem.deformation == Deformation::small || problem.continuum == Continuum::cauchy) return;
  std::vector<Increment<dim>> predicted =
      discretisation.increments(iterate.displacement + change.displacement);
  Eigen::VectorXd left = Eigen::VectorXd::Zero(iterate.displacement.size());
  Eigen::VectorXd volume = left;
  double largest = 0.0;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    const typename Cosserat<dim>::Rotation behind = left_behind<dim>(predicted[i]);
    largest = std::max(largest, behind.cwiseAbs().maxCoeff());
    const auto element = static_cast<std::size_t>(discretisation.element_of_point(i));
    for (const int node : problem.mesh.elements[element].nodes) {
      for (int k = 0; k < Cosserat<dim>::rotations; ++k) {
        const Eigen::Index entry = entry_of<dim>(static_cast<Eigen::Index>(node)) + dim + k;
        left(entry) += discretisation.point(i).volume * behind(k);
        volume(entry) += discretisation.point(i).volume;
      }
    }
  }
  if (largest < kLeast) return;
  // Of nodes that share a micro-rotation the mean.
  const Eigen::VectorXd volumes = constraints.restrict_to_free(volume);
  const Eigen::VectorXd sums = constraints.restrict_to_free(left);
  constraints.add_free((volumes.array() > 0.0).select(sums.cwiseQuotient(volumes), 0.0), change.displacement);
}

template void Newton<2>::turn_predictor(const Iterate&, Correction&) const;
template void Newton<3>::turn_predictor(const Iterate&, Correction&) const;

}  // namespace polargrain::fem
