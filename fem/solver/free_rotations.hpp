// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>

#include "common/response.hpp"
#include "fem/mesh/mesh.hpp"
#include "fem/solver/constraints.hpp"
#include "fem/solver/discretisation.hpp"

namespace polargrain::fem {

/// Looks for micro-rotations that no stiffness and no support holds, which would make the tangent singular.
/// Nodes that couple stiffness joins turn together; such a group is held where the micro-rotation of a node
/// is given or an element around it has skew stiffness.
/// @param responses tangents of the initial state, one a point.
/// @return a message that says where and what to do; empty when every rotation is held.
template <int dim>
std::string unresisted_rotation(const Mesh<dim>& mesh, const Discretisation<dim>& discretisation,
                                const Constraints<dim>& constraints,
                                std::span<const Response<dim>> responses);

}  // namespace polargrain::fem
