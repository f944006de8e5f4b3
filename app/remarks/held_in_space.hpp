// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <vector>

#include "fem/solver/problem.hpp"

namespace polargrain::app {

/// Whether displacements that are prescribed to move count as held.
enum class Movers { held, left_out };

/// By node of a body in space: which displacements are prescribed.
std::vector<std::array<bool, 3>> held_nodes_in_space(const fem::Problem<3>& problem,
                                                     Movers movers = Movers::held);

/// Whether the displacement along the normal of a face is prescribed at all of its nodes.
bool is_held(const fem::Mesh<3>& mesh, const std::vector<int>& nodes,
             const std::vector<std::array<bool, 3>>& held);

/// The one axis along which the body is held at both of its ends, as in plane strain; -1 where there is no such one, or several.
int axis_of_plane_strain(const fem::Problem<3>& problem);

}  // namespace polargrain::app
