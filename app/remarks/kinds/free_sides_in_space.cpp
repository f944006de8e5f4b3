// SPDX-License-Identifier: GPL-2.0-or-later
// Vertical sides of ground in space that nothing holds, under its weight.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "app/remarks/held_in_space.hpp"
#include "app/remarks/kinds.hpp"
#include "fem/mesh/box_around.hpp"

namespace polargrain::app {
namespace {

constexpr double kWholeSide = 0.9;  // of a side
constexpr double kWide = 2.0;       // over the height: narrower bodies may stand free, as specimens do

using Face = std::vector<int>;  // its nodes, sorted

/// Faces of one element alone, with the area of their corners, m2.
std::map<Face, double> outline_faces(const fem::Mesh<3>& mesh) {
  std::map<Face, double> faces;
  std::set<Face> inside;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
    const auto& type = *mesh.elements[static_cast<std::size_t>(e)].type;
    for (int side = 0; side < static_cast<int>(type.sides.size()); ++side) {
      const std::vector<int> nodes = mesh.side_nodes({e, side});
      const auto at = [&](int k) -> const Eigen::Vector3d& {
        return mesh.nodes[static_cast<std::size_t>(nodes[static_cast<std::size_t>(k)])];
      };
      Eigen::Vector3d twice = Eigen::Vector3d::Zero();
      for (int k = 2; k < type.sides[static_cast<std::size_t>(side)].type->corners; ++k)
        twice += (at(k - 1) - at(0)).cross(at(k) - at(0));
      Face face = nodes;
      std::ranges::sort(face);
      if (!faces.emplace(face, 0.5 * twice.norm()).second) inside.insert(face);
    }
  }
  for (const Face& face : inside) faces.erase(face);
  return faces;
}

/// Nodes whose displacement along an axis is given, tied, or whose face carries a load.
std::vector<std::array<bool, 3>> carried(const fem::Problem<3>& problem) {
  std::vector<std::array<bool, 3>> nodes = held_nodes_in_space(problem);
  const auto carry = [&](int node) { nodes[static_cast<std::size_t>(node)].fill(true); };
  for (const fem::BoundaryLoad<3>& load : problem.boundary_loads)
    for (const int node : problem.mesh.nodes_on(load.on)) carry(node);
  for (const fem::Tie& tie : problem.ties)
    for (const std::string& name : {tie.on, tie.to})
      for (const int node : problem.mesh.nodes_on(name)) carry(node);
  for (const auto& [one, other] : fem::joined_nodes(problem)) {
    carry(one);
    carry(other);
  }
  return nodes;
}

bool has_weight(const fem::Problem<3>& problem) {
  return std::ranges::any_of(problem.body_loads, [&](const fem::BodyLoad<3>& load) {
    return load.density(problem.mesh.nodes.front())(2) * load.factor.largest_magnitude() < 0.0;
  });
}

}  // namespace

void free_sides_in_space(const Scene& scene, Remarks& remarks) {
  const fem::Problem<3>& problem = scene.problem_of<3>();
  if (!has_weight(problem)) return;
  const auto nodes = carried(problem);
  const auto faces = outline_faces(problem.mesh);
  const fem::BoxAround<3> box = fem::box_around(problem.mesh);
  const Eigen::Vector3d sides = box.sides();
  for (int axis = 0; axis < 2; ++axis) {
    const double whole = sides(2) * sides(1 - axis);
    const auto is_free = [&](double end) {
      double all = 0.0;
      double free = 0.0;
      for (const auto& [face, area] : faces) {
        const auto is_there = [&](int node) {
          return std::abs(problem.mesh.nodes[static_cast<std::size_t>(node)](axis) - end) <
                 1e-6 * sides(axis);
        };
        if (!std::ranges::all_of(face, is_there)) continue;
        all += area;
        const bool is_carried = std::ranges::all_of(face, [&](int node) {
          return nodes[static_cast<std::size_t>(node)][static_cast<std::size_t>(axis)];
        });
        if (!is_carried) free += area;
      }
      return all > kWholeSide * whole && free > kWholeSide * all;
    };
    const bool lower = is_free(box.least(axis));
    const bool upper = is_free(box.largest(axis));
    if (!lower && !upper) continue;
    if (lower && upper && sides(axis) < kWide * sides(2)) continue;
    const std::string which =
        lower && upper ? fmt::format("both ends of the mesh along {} are", axis + 1)
                       : fmt::format("its {} end along {} is", lower ? "lower" : "upper", axis + 1);
    remarks.push_back(
        {Rank::wrong, 5.0,
         scene.place({"boundary"})
             .fault(fmt::format(
                 "boundary: {} free over the whole height ({:.3g} m) under weight: the ground flows out there",
                 which, sides(2))),
         fmt::format("hold such a side, as rollers do: {{on: SIDE, fix: [u{}]}}; or load it", axis + 1)});
  }
}

}  // namespace polargrain::app
