// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/outline.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "fem/element/dofs.hpp"
#include "fem/mesh/box_around.hpp"

namespace polargrain::app {
namespace {

/// Outward, of the length or area of the side.
Eigen::Vector2d area_vector(const std::vector<Eigen::Vector2d>& polygon) {
  const Eigen::Vector2d way = polygon[1] - polygon[0];
  return {way.y(), -way.x()};
}
Eigen::Vector3d area_vector(const std::vector<Eigen::Vector3d>& polygon) {
  Eigen::Vector3d twice = Eigen::Vector3d::Zero();
  for (std::size_t k = 2; k < polygon.size(); ++k)
    twice += (polygon[k - 1] - polygon[0]).cross(polygon[k] - polygon[0]);
  return 0.5 * twice;
}

template <int dim>
std::vector<int> corners_of(const fem::Mesh<dim>& mesh, const fem::BoundarySide& side) {
  std::vector<int> nodes = mesh.side_nodes(side);
  nodes.resize(static_cast<std::size_t>(mesh.side_of(side).type->corners));
  return nodes;
}

template <int dim>
std::vector<int> sorted_corners(const fem::Mesh<dim>& mesh, const fem::BoundarySide& side) {
  std::vector<int> corners = corners_of(mesh, side);
  std::ranges::sort(corners);
  return corners;
}

}  // namespace

template <int dim>
OutlineSide<dim> side_at(const fem::Mesh<dim>& mesh, const fem::BoundarySide& side) {
  OutlineSide<dim> out{side.element, side.side, mesh.side_nodes(side), corners_of(mesh, side), {}, {},
                       {},           0.0};
  // Faces with nodes amid their edges may be curved.
  const bool has_middles = dim == 3 && out.nodes.size() >= 2 * out.corners.size();
  std::vector<typename Cosserat<dim>::Place> polygon;
  out.centre.setZero();
  for (std::size_t k = 0; k < out.corners.size(); ++k) {
    polygon.push_back(mesh.nodes[static_cast<std::size_t>(out.corners[k])]);
    out.centre += polygon.back() / static_cast<double>(out.corners.size());
    if (has_middles)
      polygon.push_back(mesh.nodes[static_cast<std::size_t>(out.nodes[out.corners.size() + k])]);
  }
  out.normal = area_vector(polygon);
  out.size = out.normal.norm();
  out.normal /= std::max(out.size, 1e-300);
  return out;
}

template <int dim>
std::vector<OutlineSide<dim>> outline_of(const fem::Mesh<dim>& mesh) {
  const auto visit = [&](auto&& each) {
    for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
      const auto sides = static_cast<int>(mesh.elements[static_cast<std::size_t>(e)].type->sides.size());
      for (int side = 0; side < sides; ++side) each(fem::BoundarySide{e, side});
    }
  };
  std::map<std::vector<int>, int> elements;  // of a side, by its corners
  visit([&](const fem::BoundarySide& side) { ++elements[sorted_corners(mesh, side)]; });
  std::map<std::pair<int, int>, std::vector<std::string>> names;
  for (const auto& [name, sides] : mesh.boundaries)
    for (const fem::BoundarySide& side : sides) names[{side.element, side.side}].push_back(name);
  std::vector<OutlineSide<dim>> outline;
  visit([&](const fem::BoundarySide& side) {
    if (elements[sorted_corners(mesh, side)] > 1) return;
    outline.push_back(side_at(mesh, side));
    if (const auto named = names.find({side.element, side.side}); named != names.end())
      outline.back().names = named->second;
  });
  return outline;
}

template <int dim>
std::vector<OutlineSide<dim>> sides_of(const fem::Mesh<dim>& mesh, const std::string& boundary) {
  if (boundary.empty()) return without_names(outline_of(mesh));
  std::vector<OutlineSide<dim>> sides;
  for (const fem::BoundarySide& side : mesh.boundaries.at(boundary)) {
    sides.push_back(side_at(mesh, side));
    sides.back().names = {boundary};
  }
  return sides;
}

template <int dim>
HeldNodes<dim> held_nodes(const fem::Problem<dim>& problem, Movers movers) {
  HeldNodes<dim> held(problem.mesh.nodes.size());
  for (const fem::PrescribedDof<dim>& item : problem.prescribed) {
    if (fem::is_rotation(item.dof) || !problem.mesh.has_nodes_on(item.on)) continue;
    if (movers == Movers::left_out && item.value.largest_magnitude() > 0.0) continue;
    for (const int node : problem.mesh.nodes_on(item.on))
      held[static_cast<std::size_t>(node)][static_cast<std::size_t>(fem::axis_of(item.dof))] = true;
  }
  return held;
}

template <int dim>
HeldNodes<dim> carried_nodes(const fem::Problem<dim>& problem) {
  HeldNodes<dim> carried = held_nodes(problem);
  for (const auto& [one, other] : fem::joined_nodes(problem))
    for (const int node : {one, other}) carried[static_cast<std::size_t>(node)].fill(true);
  return carried;
}

template <int dim>
std::vector<std::optional<double>> given_at(const fem::Problem<dim>& problem, fem::Dof dof, double time) {
  std::vector<std::optional<double>> given(problem.mesh.nodes.size());
  for (const fem::PrescribedDof<dim>* const item : fem::in_precedence(problem)) {
    if (item->dof != dof || !problem.mesh.has_nodes_on(item->on)) continue;
    for (const int node : problem.mesh.nodes_on(item->on)) {
      std::optional<double>& value = given[static_cast<std::size_t>(node)];
      if (value) continue;
      const auto& place = problem.mesh.nodes[static_cast<std::size_t>(node)];
      value = item->value.at(time) * (item->profile ? item->profile(place) : 1.0);
    }
  }
  return given;
}

template <int dim>
Held<dim> held_along(const std::vector<OutlineSide<dim>>& sides, const HeldNodes<dim>& held) {
  constexpr double kAlong = 1e-6;
  Held<dim> result;
  result.all.fill(true);
  for (const OutlineSide<dim>& side : sides)
    for (std::size_t i = 0; i < dim; ++i) {
      const bool here =
          std::ranges::all_of(side.nodes, [&](int node) { return held[static_cast<std::size_t>(node)][i]; });
      result.all[i] = result.all[i] && here;
      if (std::abs(side.normal(static_cast<Eigen::Index>(i))) > kAlong) result.normal = result.normal && here;
    }
  return result;
}

int axis_of_plane_strain(const fem::Problem<3>& problem) {
  const HeldNodes<3> held = held_nodes(problem, Movers::left_out);
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

template OutlineSide<2> side_at(const fem::Mesh<2>&, const fem::BoundarySide&);
template OutlineSide<3> side_at(const fem::Mesh<3>&, const fem::BoundarySide&);
template std::vector<OutlineSide<2>> outline_of(const fem::Mesh<2>&);
template std::vector<OutlineSide<3>> outline_of(const fem::Mesh<3>&);
template std::vector<OutlineSide<2>> sides_of(const fem::Mesh<2>&, const std::string&);
template std::vector<OutlineSide<3>> sides_of(const fem::Mesh<3>&, const std::string&);
template HeldNodes<2> held_nodes(const fem::Problem<2>&, Movers);
template HeldNodes<3> held_nodes(const fem::Problem<3>&, Movers);
template HeldNodes<2> carried_nodes(const fem::Problem<2>&);
template HeldNodes<3> carried_nodes(const fem::Problem<3>&);
template std::vector<std::optional<double>> given_at(const fem::Problem<2>&, fem::Dof, double);
template std::vector<std::optional<double>> given_at(const fem::Problem<3>&, fem::Dof, double);
template Held<2> held_along(const std::vector<OutlineSide<2>>&, const HeldNodes<2>&);
template Held<3> held_along(const std::vector<OutlineSide<3>>&, const HeldNodes<3>&);

}  // namespace polargrain::app
