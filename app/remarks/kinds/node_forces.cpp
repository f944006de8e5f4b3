// SPDX-License-Identifier: GPL-2.0-or-later
// Forces and moments on rows of nodes, of which each place takes the whole; forces on the axis of a sector, and beside walls.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "app/remarks/kinds.hpp"
#include "fem/beam/beam.hpp"

namespace polargrain::app {
namespace {

/// Places of nodes, by their coordinates.
template <int dim>
std::set<std::array<double, dim>> places_of(const fem::Mesh<dim>& mesh, const std::vector<int>& nodes) {
  std::set<std::array<double, dim>> places;
  for (const int node : nodes) {
    std::array<double, dim> place;
    Eigen::Map<typename Cosserat<dim>::Place>(place.data()) = mesh.nodes[static_cast<std::size_t>(node)];
    places.insert(place);
  }
  return places;
}

/// Whether an element has several of them. Single points, such as a group of posts, are meant one by one.
template <int dim>
bool are_neighbours(const fem::Mesh<dim>& mesh, const std::set<std::array<double, dim>>& places) {
  return std::ranges::any_of(mesh.elements, [&](const fem::Element<dim>& element) {
    return std::ranges::count_if(element.nodes, [&](int node) {
             std::array<double, dim> place;
             Eigen::Map<typename Cosserat<dim>::Place>(place.data()) =
                 mesh.nodes[static_cast<std::size_t>(node)];
             return places.contains(place);
           }) > 1;
  });
}

const coupler::Entry& place_in(const Scene& scene, const fem::NodeLoad& load) {
  const coupler::Entry* const entry = scene.boundary_value(load.on, "node_force");
  return entry != nullptr ? *entry : scene.place({"boundary"});
}

template <int dim>
void look_at_row(const Scene& scene, const fem::Mesh<dim>& mesh, const fem::NodeLoad& load,
                 Remarks& remarks) {
  const auto places = places_of(mesh, mesh.nodes_on(load.on));
  if (places.size() < 2 || !are_neighbours<dim>(mesh, places)) return;
  const bool turns = fem::is_rotation(load.dof);
  const bool is_boundary = mesh.boundaries.contains(load.on);
  const char* const unit = turns == (dim == 2) ? "kN" : turns ? "kNm" : "kN/m";
  const double value = 1e-3 * load.value.largest_magnitude();
  const auto count = static_cast<double>(places.size());
  remarks.push_back(
      {Rank::doubtful, count,
       place_in(scene, load)
           .fault(fmt::format(
               "boundary: each of the {:.0f} nodes of '{}' takes a {} of {:.4g} {}: {:.4g} {} in all", count,
               load.on, turns ? "moment" : "force", value, unit, count * value, unit)),
       turns ? "give the moment to one node, such as the end of a beam; or give forces, a pair for a moment"
       : is_boundary
           ? "give a pressure or a traction, whose sum does not depend on the mesh; or name a set of single nodes"
           : "name one node, a corner or a physical point; or give each its share"});
}

/// The nodes on the axis of half a cylinder, or a quarter, carry the force of this sector alone.
void look_at_axis(const Scene& scene, const fem::Mesh<3>& mesh, const fem::NodeLoad& load, Remarks& remarks) {
  const coupler::Entry* const sector = scene.find({"mesh", "cylinder", "sector"});
  if (sector == nullptr || fem::is_rotation(load.dof) ||
      (sector->text != "half" && sector->text != "quarter"))
    return;
  const double tolerance = 1e-9 * scene.body().smaller_side();
  const bool on_axis = std::ranges::all_of(mesh.nodes_on(load.on), [&](int node) {
    return mesh.nodes[static_cast<std::size_t>(node)].head<2>().norm() < tolerance;
  });
  if (!on_axis) return;
  const double parts = sector->text == "half" ? 2.0 : 4.0;
  const double value = 1e-3 * load.value.largest_magnitude();
  remarks.push_back(
      {Rank::doubtful, parts,
       place_in(scene, load)
           .fault(fmt::format(
               "boundary: '{}' is on the axis, and the mesh is a {} of the cylinder: {:.4g} kN on this "
               "sector are {:.4g} kN on the whole",
               load.on, sector->text, value, parts * value)),
       fmt::format("for {:.4g} kN on the whole cylinder give {:.4g} kN", value, value / parts)});
}

/// The smallest set of nodes with that one.
std::string set_of_node(const fem::Mesh<2>& mesh, int node) {
  const std::pair<const std::string, std::vector<int>>* smallest = nullptr;
  for (const auto& set : mesh.node_sets)
    if (std::ranges::find(set.second, node) != set.second.end() &&
        (smallest == nullptr || set.second.size() < smallest->second.size()))
      smallest = &set;
  return smallest == nullptr ? "" : smallest->first;
}

/// A wall in an interface has nodes of its own, and a node of the mesh there is one of the ground.
void look_at_wall(const Scene& scene, const fem::Problem<2>& problem, const fem::NodeLoad& load,
                  Remarks& remarks) {
  const std::size_t field = fem::number_of_field(problem.fields, fem::kBeamRotation);
  if (field == problem.fields.size()) return;
  const std::vector<int> nodes = problem.mesh.nodes_on(load.on);
  const auto places = places_of(problem.mesh, nodes);
  for (const int node : problem.fields[field].nodes) {
    const auto& place = problem.mesh.nodes[static_cast<std::size_t>(node)];
    if (!places.contains({place(0), place(1)})) continue;
    const std::string wall = set_of_node(problem.mesh, node);
    if (std::ranges::find(nodes, node) != nodes.end() || wall.empty()) return;
    remarks.push_back(
        {Rank::doubtful, 2.0,
         place_in(scene, load)
             .fault(fmt::format(
                 "boundary: the force on '{}' acts on the ground, and not on the wall, whose own node there is in '{}'",
                 load.on, wall)),
         fmt::format("for a force on the wall name '{}'", wall)});
    return;
  }
}

}  // namespace

void node_forces(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&]<int dim>(const fem::Problem<dim>& problem) {
    for (const fem::NodeLoad& load : problem.node_loads) {
      if (load.value.largest_magnitude() == 0.0) continue;
      look_at_row(scene, problem.mesh, load, remarks);
      if constexpr (dim == 3)
        look_at_axis(scene, problem.mesh, load, remarks);
      else
        look_at_wall(scene, problem, load, remarks);
    }
  });
}

}  // namespace polargrain::app
