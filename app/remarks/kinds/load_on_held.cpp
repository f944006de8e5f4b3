// SPDX-License-Identifier: GPL-2.0-or-later
// Loads on displacements that supports or movements prescribe: they do nothing.
#include <fmt/format.h>

#include <algorithm>

#include "app/remarks/held_in_space.hpp"
#include "app/remarks/kinds.hpp"

namespace polargrain::app {
namespace {

void add(const Scene& scene, const std::string& on, const char* key, const std::string& what,
         Remarks& remarks) {
  const coupler::Entry* const value = scene.boundary_value(on, key);
  remarks.push_back(
      {Rank::wrong, 10.0,
       (value != nullptr ? *value : scene.place({"boundary"}))
           .fault(fmt::format(
               "boundary: {} on '{}' has no effect: the displacement along it is prescribed at all of its "
               "nodes, and a support takes the load",
               what, on)),
       "remove the load, or the 'fix' or 'move' of that displacement"});
}

bool is_zero(const fem::TimeTable& table) {
  return table.largest_magnitude() == 0.0;
}

}  // namespace

namespace {

void look_in_space(const Scene& scene, const fem::Problem<3>& problem, Remarks& remarks) {
  const auto held = held_nodes_in_space(problem);
  const auto along = [&](const std::vector<int>& nodes, std::size_t i) {
    return std::ranges::all_of(nodes, [&](int node) { return held[static_cast<std::size_t>(node)][i]; });
  };
  for (const fem::BoundaryLoad<3>& load : problem.boundary_loads) {
    const auto& faces = problem.mesh.boundaries.at(load.on);
    if (!is_zero(load.pressure) && std::ranges::all_of(faces, [&](const fem::BoundarySide& face) {
          return is_held(problem.mesh, problem.mesh.side_nodes(face), held);
        }))
      add(scene, load.on, "pressure", "the pressure", remarks);
    for (std::size_t i = 0; i < 3; ++i)
      if (!is_zero(load.traction[i]) && along(problem.mesh.nodes_on(load.on), i)) {
        add(scene, load.on, "traction", fmt::format("the traction along {}", i + 1), remarks);
        break;
      }
  }
  for (const fem::NodeLoad& load : problem.node_loads) {
    if (fem::is_rotation(load.dof) || is_zero(load.value)) continue;
    const auto i = static_cast<std::size_t>(fem::axis_of(load.dof));
    if (along(problem.mesh.nodes_on(load.on), i))
      add(scene, load.on, "node_force", fmt::format("the force along {}", i + 1), remarks);
  }
}

}  // namespace

void load_on_held(const Scene& scene, Remarks& remarks) {
  if (scene.dimension() == 3)
    return scene.with_problem([&]<int dim>(const fem::Problem<dim>& problem) {
      if constexpr (dim == 3) look_in_space(scene, problem, remarks);
    });
  const fem::Problem<2>& problem = scene.problem();
  const auto held = held_nodes(problem);
  for (const fem::BoundaryLoad<2>& load : problem.boundary_loads) {
    const Held here = held_along(edges_of(problem.mesh, load.on), held);
    if (!is_zero(load.pressure) && here.normal) add(scene, load.on, "pressure", "the pressure", remarks);
    const bool first = !is_zero(load.traction[0]) && here.all[0];
    if (first || (!is_zero(load.traction[1]) && here.all[1]))
      add(scene, load.on, "traction", fmt::format("the traction along {}", first ? 1 : 2), remarks);
  }
  for (const fem::NodeLoad& load : problem.node_loads) {
    if (load.dof == fem::Dof::w || is_zero(load.value)) continue;
    const std::size_t i = load.dof == fem::Dof::u1 ? 0 : 1;
    const std::vector<int> nodes = problem.mesh.nodes_on(load.on);
    if (std::ranges::all_of(nodes, [&](int node) { return held[static_cast<std::size_t>(node)][i]; }))
      add(scene, load.on, "node_force", fmt::format("the force along {}", i + 1), remarks);
  }
}

}  // namespace polargrain::app
