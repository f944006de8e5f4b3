// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "fem/output/vtu.hpp"

namespace polargrain::fem {

/// Weights of the values at the integration points of an element that give the linear field nearest to them (the mean, where
/// it has too few) at places of the reference element: a row a place.
template <int dim>
Eigen::MatrixXd extrapolation_to(const ElementType<dim>& type,
                                 const std::vector<typename Cosserat<dim>::Place>& places);

/// Values at the integration points brought to the nodes: in each element the linear field that is nearest to its points
/// (the mean, where it has too few), drawn on to its nodes; there the mean of the elements around, by their
/// volumes. A field that is linear in space comes out as it is where elements have straight sides (parallelograms, for
/// quadrilaterals), at the boundary too; a jump between materials is smeared over the elements beside it.
/// @param at_points a field with values of all points, in the order of Solver::points
/// @param known by point: whether the value counts; empty: all do. Nodes without a value get 0.
template <int dim>
Field smoothed(const Solver<dim>& solver, const Field& at_points, const std::vector<bool>& known = {});

}  // namespace polargrain::fem
