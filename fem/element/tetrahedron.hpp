// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "fem/element/element_type.hpp"

namespace polargrain::fem {

/// T10: quadratic, 4 points; the element of Gmsh for any body.
ElementType<3> tetrahedron10();

}  // namespace polargrain::fem
