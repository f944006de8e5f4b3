// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <array>

#include "fem/element/element_type.hpp"

namespace polargrain::fem {

/// Faces of an element in space.
/// @param corners of each face, counter-clockwise seen from outside @param edges corners of each edge with a middle node, in
/// the order of these nodes; empty where there is no middle node @param first number of the first middle node
/// @param type interpolation of each face; must outlive the program's use of them
inline std::vector<ElementSide<3>> faces(const std::vector<std::vector<int>>& corners,
                                         const std::vector<std::array<int, 2>>& edges, int first,
                                         const ElementType<2>& type) {
  std::vector<ElementSide<3>> made;
  for (const std::vector<int>& of_face : corners) {
    ElementSide<3>& face = made.emplace_back(ElementSide<3>{of_face, &type});
    if (edges.empty()) continue;
    for (std::size_t k = 0; k < of_face.size(); ++k) {
      const int a = of_face[k];
      const int b = of_face[(k + 1) % of_face.size()];
      const auto edge = std::ranges::find_if(edges, [&](const std::array<int, 2>& ends) {
        return (ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a);
      });
      face.nodes.push_back(first + static_cast<int>(edge - edges.begin()));
    }
  }
  return made;
}

}  // namespace polargrain::fem
