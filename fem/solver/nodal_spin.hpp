// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "fem/solver/constraints.hpp"
#include "fem/solver/discretisation.hpp"
#include "fem/solver/problem.hpp"

namespace polargrain::fem {

/// The rotation of the continuum over a step at the unknown micro-rotations: the mean over the elements around, by their
/// volumes.
/// @param moved nodal displacements over the step, given ones included
/// @returns rad, in the order of the equations; 0 at all other unknowns and without micro-rotations
template <int dim>
Eigen::VectorXd nodal_spin(const Problem<dim>& problem, const Discretisation<dim>& discretisation,
                           const Constraints<dim>& constraints, const Eigen::VectorXd& moved);

}  // namespace polargrain::fem
