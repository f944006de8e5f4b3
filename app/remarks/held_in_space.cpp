// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/held_in_space.hpp"

#include <algorithm>
#include <cmath>

#include "fem/element/dofs.hpp"
#include "fem/mesh/box_around.hpp"

namespace polargrain::app {
namespace {

/// Normal of a flat face by its first three corners; its sign does not matter here.
Eigen::Vector3d normal_of(const fem::Mesh<3>& mesh, const std::vector<int>& nodes) {
  const auto at = [&](std::size_t k) { return mesh.nodes[static_cast<std::size_t>(nodes[k])]; };
  return (at(1) - at(0)).cross(at(2) - at(0)).normalized();
}

}  // namespace

std::vector<std::array<bool, 3>> held_nodes_in_space(const fem::Problem<3>& problem, Movers movers) {
  std::vector<std::array<bool, 3>> held(problem.mesh.nodes.size(), {false, false, false});
  for (const fem::PrescribedDof<3>& item : problem.prescribed) {
    if (fem::is_rotation(item.dof) || !problem.mesh.has_nodes_on(item.on)) continue;
    if (movers == Movers::left_out && item.value.largest_magnitude() > 0.0) continue;
    for (const int node : problem.mesh.nodes_on(item.on))
      held[static_cast<std::size_t>(node)][static_cast<std::size_t>(fem::axis_of(item.dof))] = true;
  }
  return held;
}

bool is_held(const fem::Mesh<3>& mesh, const std::vector<int>& nodes,
             const std::vector<std::array<bool, 3>>& held) {
  constexpr double kAlong = 1e-6;
  const Eigen::Vector3d normal = normal_of(mesh, nodes);
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(normal(static_cast<Eigen::Index>(i))) < kAlong) continue;
    if (!std::ranges::all_of(nodes, [&](int node) { return held[static_cast<std::size_t>(node)][i]; }))
      return false;
  }
  return true;
}

int axis_of_plane_strain(const fem::Problem<3>& problem) {
  const auto held = held_nodes_in_space(problem, Movers::left_out);
  const auto [least, largest] = fem::box_around(problem.mesh);
  int found = -1;
  for (int i = 0; i < 3; ++i) {
    const double slack = 1e-6 * (largest(i) - least(i));
    bool is_free = false;
    for (std::size_t node = 0; node < held.size(); ++node) {
      const double x = problem.mesh.nodes[node](i);
      const bool at_end = x < least(i) + slack || x > largest(i) - slack;
      is_free = is_free || (at_end && !held[node][static_cast<std::size_t>(i)]);
    }
    if (is_free) continue;
    if (found >= 0) return -1;
    found = i;
  }
  return found;
}

}  // namespace polargrain::app
