// SPDX-License-Identifier: GPL-2.0-or-later
// Loads on displacements that supports or movements prescribe: they do nothing.
#include <fmt/format.h>

#include <algorithm>

#include "app/remarks/kinds.hpp"
#include "app/remarks/outline.hpp"

namespace polargrain::app {
namespace {

constexpr const char* kWay = "displacement along it";

void add(const Scene& scene, const std::string& on, const char* key, const std::string& what,
         const std::string& along, Remarks& remarks) {
  const coupler::Entry* const value = scene.boundary_value(on, key);
  remarks.push_back(
      {Rank::wrong, 10.0,
       (value != nullptr ? *value : scene.place({"boundary"}))
           .fault(fmt::format("boundary: {} on '{}' has no effect: the {} is prescribed at all of its "
                              "nodes, and a support takes the load",
                              what, on, along)),
       "remove the load, or the 'fix' or 'move' there"});
}

/// Whether the rotation that takes a moment at a node is prescribed.
template <int dim>
bool is_turn_held(const fem::Problem<dim>& problem, int stage, const fem::NodeLoad& load, int node) {
  const auto has = [&](const std::string& on) {
    const std::vector<int> nodes = problem.mesh.nodes_on(on);
    return std::ranges::find(nodes, node) != nodes.end();
  };
  const std::size_t field = fem::number_of_field(problem.fields, load.field);
  if (field < problem.fields.size() &&
      std::ranges::find(problem.fields[field].nodes, node) != problem.fields[field].nodes.end())
    return std::ranges::any_of(problem.prescribed_fields, [&](const auto& item) {
      return item.field == load.field && item.life.holds(stage) && has(item.on);
    });
  return std::ranges::any_of(problem.prescribed,
                             [&](const auto& item) { return item.dof == load.dof && has(item.on); });
}

bool is_zero(const fem::TimeTable& table) {
  return table.largest_magnitude() == 0.0;
}

/// A load of an earlier stage has done its work before a support of this one takes it.
bool is_of_stage(const Scene& scene, const fem::Lifetime& life) {
  return scene.stage() == 0 || life.begin == scene.stage();
}

template <int dim>
void look_at_held_loads(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  const HeldNodes<dim> held = held_nodes(problem);
  for (const fem::BoundaryLoad<dim>& load : problem.boundary_loads) {
    if (!is_of_stage(scene, load.life)) continue;
    const Held<dim> here = held_along(sides_of(problem.mesh, load.on), held);
    if (!is_zero(load.pressure) && here.normal)
      add(scene, load.on, "pressure", "the pressure", kWay, remarks);
    for (std::size_t i = 0; i < dim; ++i) {
      if (is_zero(load.traction[i]) || !here.all[i]) continue;
      add(scene, load.on, "traction", fmt::format("the traction along {}", i + 1), kWay, remarks);
      break;
    }
  }
  for (const fem::NodeLoad& load : problem.node_loads) {
    if (is_zero(load.value) || !is_of_stage(scene, load.life)) continue;
    const std::vector<int> nodes = problem.mesh.nodes_on(load.on);
    if (fem::is_rotation(load.dof)) {
      if (!nodes.empty() && std::ranges::all_of(nodes, [&](int node) {
            return is_turn_held(problem, scene.stage(), load, node);
          }))
        add(scene, load.on, "node_force", "the moment", "rotation", remarks);
      continue;
    }
    const auto i = static_cast<std::size_t>(fem::axis_of(load.dof));
    if (std::ranges::all_of(nodes, [&](int node) { return held[static_cast<std::size_t>(node)][i]; }))
      add(scene, load.on, "node_force", fmt::format("the force along {}", i + 1), kWay, remarks);
  }
}

}  // namespace

void load_on_held(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_at_held_loads(scene, problem, remarks); });
}

}  // namespace polargrain::app
