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

// A support that gives all three rotations of a node gives their vector, and the step is the turn from one vector to the next. One
// that gives some of them gives turns of steps about these axes.
template <int dim>
void Newton<dim>::turn_given(const StepGoal& goal, Eigen::VectorXd& increment) const {
  if constexpr (dim == 3) {
    const Eigen::VectorXd given = increment;
    const Eigen::VectorXd& now = state.displacement;
    increment -= now;
    Eigen::VectorXd before = now;
    constraints.apply(state.time, before, goal.releases_displacements ? released_ : goal.released);
    for (std::size_t node = 0; node < problem.mesh.nodes.size(); ++node) {
      const std::size_t first = entry_of<3>(node) + 3;
      const auto place = static_cast<Eigen::Index>(first);
      int held = 0;
      for (std::size_t i = 0; i < 3; ++i) held += constraints.is_free(first + i) ? 0 : 1;
      if (held == 3) {
        increment.segment<3>(place) = composed(given.segment<3>(place), -now.segment<3>(place));
        continue;
      }
      if (now.segment<3>(place).isZero(0.0)) continue;  // also what is given at the start of a run
      for (Eigen::Index i = 0; i < 3; ++i)
        if (!constraints.is_free(first + static_cast<std::size_t>(i)))
          increment(place + i) = given(place + i) - before(place + i);
    }
  }
}

template <int dim>
void Newton<dim>::add_step(const Iterate& iterate) {
  if constexpr (dim == 3) {
    constexpr double kRounding = 1e-12;
    const Eigen::VectorXd before = state.displacement;
    const Eigen::VectorXd& step = iterate.displacement;
    Eigen::VectorXd& end = state.displacement;
    end += step;
    Eigen::VectorXd given = end;
    constraints.apply(iterate.time, given, iterate.released);
    for (std::size_t node = 0; node < problem.mesh.nodes.size(); ++node) {
      const auto place = static_cast<Eigen::Index>(entry_of<3>(node) + 3);
      const Eigen::Vector3d turned = composed(step.segment<3>(place), before.segment<3>(place));
      const Eigen::Vector3d wanted = given.segment<3>(place);
      const bool is_as_given = (turned - wanted).norm() <= kRounding * (1.0 + wanted.norm());
      end.segment<3>(place) = is_as_given ? wanted : turned;
    }
  }
}

template void Newton<2>::turn_given(const StepGoal&, Eigen::VectorXd&) const;
template void Newton<3>::turn_given(const StepGoal&, Eigen::VectorXd&) const;
template void Newton<2>::add_step(const Iterate&);
template void Newton<3>::add_step(const Iterate&);
template void Newton<2>::turn_predictor(const Iterate&, Correction&) const;
template void Newton<3>::turn_predictor(const Iterate&, Correction&) const;

}  // namespace polargrain::fem
