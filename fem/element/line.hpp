// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "fem/element/element_type.hpp"

namespace polargrain::fem {

/// The sides of plane elements: first corner at -1, second at +1, then the middle node. Three points: exact for the loads on
/// sides that are curved.
const ElementType<1>& line2();
const ElementType<1>& line3();

/// Sides of a plane element in their order: corner to corner, each with its middle node where there is one.
std::vector<ElementSide<2>> sides_of_polygon(int corners, bool has_middle_nodes);

}  // namespace polargrain::fem
