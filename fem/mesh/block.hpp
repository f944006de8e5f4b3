// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <vector>

#include "fem/element/element_type.hpp"

namespace polargrain::fem {

/// A place on a grid whose spacing is half an element.
using GridPlace = std::array<int, 3>;

/// The elements that fill one block of a regular mesh, from (0, 0, 0) to (2, 2, 2): one hexahedron, two wedges or six
/// tetrahedra that fit those of the next block. @returns places of the nodes of each
std::vector<std::vector<GridPlace>> elements_of_block(const ElementType<3>& type);

}  // namespace polargrain::fem
