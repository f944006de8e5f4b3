// SPDX-License-Identifier: GPL-2.0-or-later
// Cylinders of elements with straight edges: their section is a polygon, smaller than the circle.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "app/remarks/kinds.hpp"

namespace polargrain::app {

void polygons_of_cylinders(const Scene& scene, Remarks& remarks) {
  constexpr double kMostLost = 0.01;  // of the section, and so of forces at a stress
  const coupler::Entry* const elements = scene.find({"mesh", "cylinder", "elements"});
  if (elements == nullptr || elements->items.empty()) return;
  const auto quarter = coupler::parse_quantity(elements->items.front().text, coupler::Dimension::number);
  const bool is_straight = scene.with_problem([](const auto& problem) {
    const auto& element = *problem.mesh.elements.front().type;
    return element.nodes == element.corners;
  });
  if (!quarter || !(*quarter >= 1.0) || !is_straight) return;
  const auto lost = [](double sides) {
    const double angle = 2.0 * std::numbers::pi / sides;
    return 1.0 - std::sin(angle) / angle;
  };
  const double here = lost(4.0 * *quarter);
  if (here <= kMostLost) return;
  double enough = *quarter;
  while (lost(4.0 * enough) > kMostLost) enough += 2.0;
  remarks.push_back(
      {Rank::doubtful, here / kMostLost,
       elements->fault(fmt::format(
           "mesh: the section of elements with 8 nodes is a polygon of {:.0f} sides, {:.1f} % smaller than the circle, "
           "and so are forces on it",
           4.0 * *quarter, 100.0 * here)),
       fmt::format(
           "give {:.0f} elements along the quarter, or element: H20R; or divide forces by the area of the mesh",
           enough)});
}

}  // namespace polargrain::app
