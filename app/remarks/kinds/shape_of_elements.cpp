// SPDX-License-Identifier: GPL-2.0-or-later
// Elements much longer than wide, which follow no field across their length.
#include <fmt/format.h>

#include <algorithm>

#include "app/remarks/kinds.hpp"

namespace polargrain::app {
namespace {

constexpr double kLongestElement = 20.0;

/// Longest over shortest side.
double slenderness(const fem::Mesh<2>& mesh, const fem::Element<2>& element) {
  const auto corners = static_cast<std::size_t>(element.type->corners);
  double least = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < corners; ++k) {
    const auto node = [&](std::size_t i) {
      return mesh.nodes[static_cast<std::size_t>(element.nodes[i % corners])];
    };
    const double side = (node(k + 1) - node(k)).norm();
    least = k == 0 ? side : std::min(least, side);
    largest = std::max(largest, side);
  }
  return largest / least;
}

}  // namespace

void shape_of_elements(const Scene& scene, Remarks& remarks) {
  // A column of one element answers to depth alone.
  if (!scene.problem().ties.empty() || scene.mesh().elements.size() < 2) return;
  double largest = 0.0;
  for (const fem::Element<2>& element : scene.mesh().elements)
    largest = std::max(largest, slenderness(scene.mesh(), element));
  if (largest <= kLongestElement) return;
  remarks.push_back({Rank::doubtful, largest / kLongestElement,
                     scene.place({"mesh"}).fault(fmt::format(
                         "mesh: its elements are up to {:.3g} times as long as wide (at most {:.0f})",
                         largest, kLongestElement)),
                     "divide the mesh so that elements are nearly square"});
}

}  // namespace polargrain::app
