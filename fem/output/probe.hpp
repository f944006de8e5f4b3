// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "fem/mesh/find_place.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::fem {

/// Displacement and micro-rotation there as results show them, in the order of node_dofs: m, rad. NaN outside of what is there.
template <int dim>
typename Cosserat<dim>::NodeValues displacement_at(const Solver<dim>& solver, const Probe<dim>& probe);

/// Stress (Pa) and couple stress (N/m) there: the straight function of the place that is nearest to the stresses of the
/// integration points of the element, or the mean where several elements have the place. NaN outside of what is there.
template <int dim>
typename Cosserat<dim>::Vector stress_at(const Solver<dim>& solver, const Probe<dim>& probe);

}  // namespace polargrain::fem
