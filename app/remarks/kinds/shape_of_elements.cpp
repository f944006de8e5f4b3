// SPDX-License-Identifier: GPL-2.0-or-later
// Elements much longer than wide, which follow no field across their length; elements of one point that bend.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/kinds.hpp"
#include "app/remarks/outline.hpp"

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

/// A bar or plate of elements of one point: where it bends, its stiffness is that of hourglass springs.
template <int dim>
void look_at_bending(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  constexpr double kSlender = 3.0;
  constexpr double kFewest = 4.0;  // elements over the thickness
  const std::vector<double>& sides = scene.body().sides;
  const auto thin = static_cast<Eigen::Index>(std::ranges::min_element(sides) - sides.begin());
  const double thickness = scene.body().smaller_side();
  if (!problem.ties.empty() || scene.body().larger_side() < kSlender * thickness) return;
  const HeldNodes<dim> held = held_nodes(problem);
  double least = HUGE_VAL;
  double largest = -HUGE_VAL;
  double extents = 0.0;
  int count = 0;
  for (const fem::Element<dim>& element : problem.mesh.elements) {
    double from = HUGE_VAL;
    double to = -HUGE_VAL;
    for (const int node : element.nodes) {
      const double at = problem.mesh.nodes[static_cast<std::size_t>(node)](thin);
      from = std::min(from, at);
      to = std::max(to, at);
    }
    least = std::min(least, from);
    largest = std::max(largest, to);
    if (element.type->quadrature.size() != 1) continue;
    extents += to - from;
    ++count;
  }
  if (count == 0) return;
  // A layer whose face is held does not bend.
  const auto is_held = [&](double face) {
    for (const fem::Element<dim>& element : problem.mesh.elements)
      for (const int node : element.nodes) {
        const auto at = static_cast<std::size_t>(node);
        if (std::abs(problem.mesh.nodes[at](thin) - face) < 1e-6 * thickness &&
            !held[at][static_cast<std::size_t>(thin)])
          return false;
      }
    return true;
  };
  const double elements = thickness * count / extents;
  if (elements > kFewest - 0.01 || is_held(least) || is_held(largest)) return;
  remarks.push_back(
      {Rank::doubtful, kFewest / elements,
       scene.place({"mesh"}).fault(fmt::format(
           "mesh: elements of one point over the thickness of {:.3g} m: {:.2g} (at least {:g}); where the body bends, its "
           "stiffness is that of hourglass springs",
           thickness, elements, kFewest)),
       fmt::format("element: {}, or {:g} and more elements over the thickness", dim == 2 ? "Q8R" : "H20R",
                   kFewest)});
}

}  // namespace

void shape_of_elements(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) {
    look_at_shapes(scene, problem, remarks);
    look_at_bending(scene, problem, remarks);
  });
}

}  // namespace polargrain::app
