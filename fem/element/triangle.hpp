// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "fem/element/element_type.hpp"

namespace polargrain::fem {

/// T6: quadratic, 3 points; the element of Gmsh for any outline.
ElementType<2> triangle6();

}  // namespace polargrain::fem
