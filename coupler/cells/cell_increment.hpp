// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/increment.hpp"

namespace polargrain::coupler {

bool is_zero(const Increment<2>& increment);

/// The increment that the cell of a point follows. In large deformation the increment as it is: the box turns, and its stress
/// with it. In small deformation no stress turns with the continuum, so the box
/// gets the symmetric part of the gradient, and its grains the micro-rotation against the rotation left out
/// (docs/theory/solver.md, small and large deformation).
Increment<2> increment_for_cell(const Increment<2>& of_point);

/// The same for a cell whose grains turn as they like: they feel no micro-rotation and no curvature, which may go far where
/// nothing resists them.
Increment<2> increment_for_free_cell(const Increment<2>& of_point);

}  // namespace polargrain::coupler
