// SPDX-License-Identifier: GPL-2.0-or-later
// Footings and other plates that are pushed into a side of ground with strength: where they end the stress has no bound, and few
// elements make the load of failure too high.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"
#include "app/remarks/outline.hpp"

namespace polargrain::app {
namespace {

/// To each end. Prandtl's smooth strip on a half body of elements Q8R: 16, 8.8, 4.7, 3.2 % too high with 1, 2, 4, 6 elements
/// without friction; 6.1, 3.2 % with 2, 4 of 25 degrees.
constexpr double kLeastElements = 3.0;
constexpr double kErrorOfOne = 0.17;  ///< of the load; of n elements an nth of it

/// The edges of the outline beside those of a plate.
std::vector<OutlineSide<2>> edges_beside(const Scene& scene, const std::vector<OutlineSide<2>>& plate) {
  const auto is_of_plate = [&](const OutlineSide<2>& edge) {
    return std::ranges::any_of(plate, [&](const OutlineSide<2>& own) {
      return own.element == edge.element && (own.centre - edge.centre).norm() < 1e-6 * edge.size;
    });
  };
  std::vector<OutlineSide<2>> beside = outline_of(scene.mesh());
  std::erase_if(beside, is_of_plate);
  return beside;
}

/// Ends of a plate where the same side of the body goes on, and is free to move along its normal.
std::size_t ends_within_side(const Scene& scene, const std::vector<OutlineSide<2>>& plate, int axis) {
  std::set<int> own;
  for (const OutlineSide<2>& edge : plate) own.insert(edge.nodes.begin(), edge.nodes.end());
  const auto held = held_nodes(scene.problem());
  std::set<int> ends;
  for (const OutlineSide<2>& edge : edges_beside(scene, plate)) {
    if (edge.normal.dot(plate.front().normal) < 1.0 - 1e-6) continue;
    const bool is_free = std::ranges::any_of(edge.nodes, [&](int node) {
      return !held[static_cast<std::size_t>(node)][static_cast<std::size_t>(axis)];
    });
    for (const int node : edge.nodes)
      if (is_free && own.contains(node)) ends.insert(node);
  }
  return ends.size();
}

/// Whether it is straight, across an axis, and all of it lies on ground with strength.
bool is_plate(const Scene& scene, const std::vector<OutlineSide<2>>& edges, int axis) {
  return !edges.empty() && std::ranges::all_of(edges, [&](const OutlineSide<2>& edge) {
    return std::abs(edge.normal(axis)) > 1.0 - 1e-6 && edge.normal(axis) * edges.front().normal(axis) > 0.0 &&
           is_strong(scene, scene.region_of(edge.element));
  });
}

}  // namespace

void narrow_plates(const Scene& scene, Remarks& remarks) {
  std::set<std::string> told;
  for (const fem::PrescribedDof<2>& item : scene.problem().prescribed) {
    if (item.dof == fem::Dof::w || item.value.largest_magnitude() == 0.0 ||
        !scene.mesh().boundaries.contains(item.on) || told.contains(item.on))
      continue;
    const int axis = fem::axis_of(item.dof);
    const std::vector<OutlineSide<2>> edges = sides_of(scene.mesh(), item.on);
    if (!is_plate(scene, edges, axis)) continue;
    const std::size_t ends = ends_within_side(scene, edges, axis);
    if (ends == 0) continue;
    const double elements = static_cast<double>(edges.size()) / static_cast<double>(ends);
    if (elements >= kLeastElements) continue;
    told.insert(item.on);
    remarks.push_back(
        {Rank::doubtful, kLeastElements / elements,
         scene.place({"mesh"}).fault(fmt::format(
             "boundary: '{}' is moved and measures {} element{}: where it ends the stress has no bound, and the load "
             "of failure is up to {:.0f} % too high",
             item.on, edges.size(), edges.size() == 1 ? "" : "s", 100.0 * kErrorOfOne / elements)),
         fmt::format("take {} elements or more over it",
                     static_cast<int>(2.0 * kLeastElements) * static_cast<int>(ends))});
  }
}

}  // namespace polargrain::app
