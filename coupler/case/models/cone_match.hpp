// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "coupler/case/section.hpp"
#include "fem/material/cone_matching.hpp"

namespace polargrain::coupler {

/// Reads `match`, the state in which a cone has the strength given; in the plane it is plane strain, in space triaxial
/// compression unless the case says otherwise.
fem::ConeMatch read_match(Section& section, int dimension);

}  // namespace polargrain::coupler
