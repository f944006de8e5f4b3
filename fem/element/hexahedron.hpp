// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "fem/element/element_type.hpp"

namespace polargrain::fem {

/// H20R: serendipity, 2x2x2 points. The recommended element in space; with skew and couple stiffness it has no spurious modes,
/// alone or in a mesh.
ElementType<3> hexahedron20_reduced();
/// H20: serendipity, 3x3x3 points.
ElementType<3> hexahedron20();
/// H8: trilinear, 2x2x2 points, mean dilatation. Stiff in bending: for fine meshes.
ElementType<3> hexahedron8();
/// H8R: trilinear, one point, springs against hourglass patterns. Cheap, for cells of grains and explicit steps.
ElementType<3> hexahedron8_one_point();

}  // namespace polargrain::fem
