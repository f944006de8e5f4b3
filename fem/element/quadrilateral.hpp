// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "fem/element/element_type.hpp"

namespace polargrain::fem {

/// Q4: bilinear, 2x2 points, mean dilatation. Still stiff in bending (9.7 % on an 8 x 4 mesh): for fine
/// meshes.
ElementType<2> quadrilateral4();
/// Q4R: bilinear, one point, springs against hourglass patterns. Cheap, for cells of grains and explicit steps.
ElementType<2> quadrilateral4_one_point();
/// Q8R: serendipity, 2x2 points. The recommended element: no spurious modes in a mesh, soft in plastic flow.
ElementType<2> quadrilateral8_reduced();
/// Q8: serendipity, 3x3 points. Stiffer than Q8R in flow at constant volume.
ElementType<2> quadrilateral8();

}  // namespace polargrain::fem
