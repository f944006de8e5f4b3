// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/mesh/block.hpp"

namespace polargrain::fem {
namespace {

constexpr std::array<GridPlace, 8> kCornersOfCell{
    {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}}};

/// Corners of each element by their numbers in the block. The tetrahedra lie around the diagonal from corner 0 to corner 6.
std::vector<std::vector<int>> corners_in_block(const ElementType<3>& type) {
  if (type.corners == 8) return {{0, 1, 2, 3, 4, 5, 6, 7}};
  if (type.corners == 6) return {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}};
  return {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
}

/// Adds the places of the middle nodes behind those of the corners: the reference element mapped by them.
void add_middle_nodes(const ElementType<3>& type, std::vector<GridPlace>& places) {
  const std::size_t corners = places.size();
  for (std::size_t a = corners; a < type.node_positions.size(); ++a) {
    // A middle node lies half way between the two corners whose reference positions it halves.
    for (std::size_t b = 0; b < corners; ++b)
      for (std::size_t c = b + 1; c < corners; ++c) {
        if (2.0 * type.node_positions[a] != type.node_positions[b] + type.node_positions[c]) continue;
        if (type.corners == 8 && (type.node_positions[b] - type.node_positions[c]).norm() > 2.0) continue;
        places.push_back({(places[b][0] + places[c][0]) / 2, (places[b][1] + places[c][1]) / 2,
                          (places[b][2] + places[c][2]) / 2});
      }
  }
}

}  // namespace

std::vector<std::vector<GridPlace>> elements_of_block(const ElementType<3>& type) {
  std::vector<std::vector<GridPlace>> elements;
  for (const std::vector<int>& corners : corners_in_block(type)) {
    std::vector<GridPlace>& places = elements.emplace_back();
    for (const int corner : corners) places.push_back(kCornersOfCell[static_cast<std::size_t>(corner)]);
    add_middle_nodes(type, places);
  }
  return elements;
}

}  // namespace polargrain::fem
