// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "common/cell_increment.hpp"
#include "common/cell_response.hpp"
#include "common/increment.hpp"

namespace polargrain {

// The plane of finite elements and of discs within the space of cells (docs/theory/continuum.md, A.7): the one place
// that knows where the seven components of Component stand among the eighteen. e_3 is normal to the plane; nothing
// moves along it, and rotations are about it.

/// The increment of a point of the plane as its cell takes it. The increment is about the start of the step already.
CellIncrement in_space(const Increment<2>& increment);

/// The part of an increment that lies in the plane.
Increment<2> in_plane(const CellIncrement& increment);

/// Why discs cannot follow an increment; nothing when it lies in their plane.
std::string out_of_plane_fault(const CellIncrement& increment);

/// @param known the worth of the components outside of the plane: all, when they are zero or s33; plane, when nothing
/// is known of them
CellResponse in_space(const Response<2>& response, KnownComponents known);

/// The components of the plane, s33 among them; zero where the cell does not know it.
Response<2> in_plane(const CellResponse& response);

}  // namespace polargrain
