// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "fem/solver/discretisation.hpp"

namespace polargrain::fem {

/// The effects that small deformation leaves out of a state: equilibrium on the mesh as it was, and stresses that do not turn.
/// @param discretisation on the mesh of the start @param displacement nodal, in all
/// @param placed_with SolverState::placed_with
/// @returns where the continuum has turned by more than 0.05 rad or strained by more than 0.1, and the effect; empty
/// where it has nowhere
template <int dim>
std::string left_out_by_small_deformation(const Discretisation<dim>& discretisation,
                                          const Eigen::VectorXd& displacement,
                                          const std::vector<typename Cosserat<dim>::Gradient>& placed_with);

}  // namespace polargrain::fem
