// SPDX-License-Identifier: GPL-2.0-or-later
// Elements much longer than wide, which follow no field across their length.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/kinds.hpp"

namespace polargrain::app {
namespace {

constexpr double kLongestElement = 20.0;

/// Longest over shortest edge.
template <int dim>
double slenderness(const fem::Mesh<dim>& mesh, const fem::Element<dim>& element) {
  double least = HUGE_VAL;
  double largest = 0.0;
  for (const fem::ElementSide<dim>& side : element.type->sides) {
    const auto corners = static_cast<std::size_t>(side.type->corners);
    const auto node = [&](std::size_t k) {
      const auto local = static_cast<std::size_t>(side.nodes[k % corners]);
      return mesh.nodes[static_cast<std::size_t>(element.nodes[local])];
    };
    for (std::size_t k = 0; k < corners; ++k) {
      const double edge = (node(k + 1) - node(k)).norm();
      least = std::min(least, edge);
      largest = std::max(largest, edge);
    }
  }
  return largest / least;
}

template <int dim>
void look_at_shapes(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  // A column of one element answers to depth alone.
  if (!problem.ties.empty() || problem.mesh.elements.size() < 2) return;
  double largest = 0.0;
  for (const fem::Element<dim>& element : problem.mesh.elements)
    largest = std::max(largest, slenderness(problem.mesh, element));
  if (largest <= kLongestElement) return;
  remarks.push_back({Rank::doubtful, largest / kLongestElement,
                     scene.place({"mesh"}).fault(fmt::format(
                         "mesh: its elements are up to {:.3g} times as long as wide (at most {:.0f})",
                         largest, kLongestElement)),
                     "divide the mesh so that elements are nearly as wide as long"});
}

}  // namespace

void shape_of_elements(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_at_shapes(scene, problem, remarks); });
}

}  // namespace polargrain::app
