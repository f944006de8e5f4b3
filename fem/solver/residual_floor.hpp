// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <span>

#include "common/response.hpp"
#include "fem/solver/constraints.hpp"
#include "fem/solver/discretisation.hpp"

namespace polargrain::fem {

/// The part of the unbalanced forces that no iteration can remove, as nodal vectors (3 a node) of absolute values.
///
/// Expected absolute value at each node of the forces that independent Gaussian errors of the stresses
/// (Response::noise) leave: sqrt(2/pi) times the root of the sum of the variances. Empty when no stress has
/// noise.
template <int dim>
Eigen::VectorXd forces_of_noise(const Discretisation<dim>& discretisation, Continuum continuum,
                                std::span<const Response<dim>> responses);

/// Bound of the forces that rounding leaves: the machine's precision times the absolute sum of all that is
/// added up at a node, B^T (|s| + |D| |B| |u|) times volume, with the displacements `increment` of the step.
template <int dim>
Eigen::VectorXd forces_of_rounding(const Discretisation<dim>& discretisation, Continuum continuum,
                                   std::span<const Response<dim>> responses,
                                   const Eigen::VectorXd& increment);

}  // namespace polargrain::fem
