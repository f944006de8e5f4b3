// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "coupler/cells/cell_calls.hpp"

namespace polargrain::coupler {

/// A tangent for a cell that was asked for its stress alone. The tangent of the start, in the axes of the end, is changed in
/// one direction, so that the increment leads to the stress found (Broyden, Math. Comp. 19 (1965) 577). Along the increment
/// a tenth of the stiffness stays at least: a stress that jumps is no tangent.
/// @param start of the increment, with its tangent @param end with its stress
/// @param length strains by curvatures count as much as this times the curvature, m
template <int dim>
typename Cosserat<dim>::Matrix secant_tangent(const Response<dim>& start, const Response<dim>& end,
                                              const Increment<dim>& increment, double length);

/// Cells that answer requests with a start (PointRequest::start) by stress alone, and give them a secant tangent.
/// @param exact answers with tangents @param stress_alone the same cells, which answer without
/// @param length see secant_tangent
template <int dim>
CellCalls<dim> with_secant_tangents(const CellCalls<dim>& exact, const CellCalls<dim>& stress_alone,
                                    double length);

/// The same of the cells of a definition; curvatures count by their mean diameter. @param pool must outlive the calls
template <int dim>
CellCalls<dim> secant_calls_of(Pool& pool, std::uint32_t definition);

}  // namespace polargrain::coupler
