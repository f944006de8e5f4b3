// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "fem/element/kinematics.hpp"
#include "fem/mesh/box_around.hpp"

namespace polargrain::app {
namespace {

OutlineEdge outline_edge(const fem::Mesh<2>& mesh, const fem::BoundarySide& edge) {
  OutlineEdge out{edge.element, mesh.side_nodes(edge), {}, {}, 0.0};
  const Eigen::Vector2d& from = mesh.nodes[static_cast<std::size_t>(out.nodes[0])];
  const Eigen::Vector2d& to = mesh.nodes[static_cast<std::size_t>(out.nodes[1])];
  const Eigen::Vector2d way = to - from;
  out.length = way.norm();
  out.centre = 0.5 * (from + to);
  out.normal = Eigen::Vector2d(way.y(), -way.x()) / std::max(out.length, 1e-300);
  return out;
}

/// All edges of the mesh that belong to one element only.
std::vector<fem::BoundarySide> outline(const fem::Mesh<2>& mesh) {
  std::map<std::pair<int, int>, std::vector<fem::BoundarySide>> edges;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
    const int sides = mesh.elements[static_cast<std::size_t>(e)].type->corners;
    for (int side = 0; side < sides; ++side) {
      const std::vector<int> nodes = mesh.side_nodes({e, side});
      edges[std::minmax(nodes[0], nodes[1])].push_back({e, side});
    }
  }
  std::vector<fem::BoundarySide> alone;
  for (const auto& [nodes, of] : edges)
    if (of.size() == 1) alone.push_back(of.front());
  return alone;
}

/// Area, or volume, of an element.
double size_of(const fem::Mesh<2>& mesh, int element) {
  const fem::Element<2>& e = mesh.elements[static_cast<std::size_t>(element)];
  double twice = 0.0;
  for (int k = 0; k < e.type->corners; ++k) {
    const Eigen::Vector2d& a = mesh.nodes[static_cast<std::size_t>(e.nodes[static_cast<std::size_t>(k)])];
    const Eigen::Vector2d& b =
        mesh.nodes[static_cast<std::size_t>(e.nodes[static_cast<std::size_t>((k + 1) % e.type->corners)])];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * std::abs(twice);
}
double size_of(const fem::Mesh<3>& mesh, int element) {
  double volume = 0.0;
  for (const fem::PointGeometry<3>& point : fem::point_geometries<3>(
           *mesh.elements[static_cast<std::size_t>(element)].type, mesh.element_positions(element)))
    volume += point.volume;
  return volume;
}

}  // namespace

template <int dim>
Body body_of(const fem::Mesh<dim>& mesh) {
  const auto [least, largest] = fem::box_around(mesh);
  Body body{least.template head<2>(), largest.template head<2>(), {}, 0.0, {}, least(dim - 1),
            largest(dim - 1)};
  for (int i = 0; i < dim; ++i) body.sides.push_back(largest(i) - least(i));
  const auto side_of = [](double size) { return dim == 2 ? std::sqrt(size) : std::cbrt(size); };
  double sum = 0.0;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
    const double of = size_of(mesh, e);
    sum += of;
    body.elements.push_back(side_of(of));
  }
  body.mean_element = side_of(sum / static_cast<double>(body.elements.size()));
  return body;
}

template Body body_of(const fem::Mesh<2>&);
template Body body_of(const fem::Mesh<3>&);

std::vector<OutlineEdge> edges_of(const fem::Mesh<2>& mesh, const std::string& boundary) {
  std::vector<OutlineEdge> edges;
  if (!boundary.empty()) {
    for (const fem::BoundarySide& edge : mesh.boundaries.at(boundary))
      edges.push_back(outline_edge(mesh, edge));
    return edges;
  }
  std::set<std::pair<int, int>> named;
  for (const auto& [name, of] : mesh.boundaries)
    for (const fem::BoundarySide& edge : of) named.insert({edge.element, edge.side});
  for (const fem::BoundarySide& edge : outline(mesh))
    if (!named.contains({edge.element, edge.side})) edges.push_back(outline_edge(mesh, edge));
  return edges;
}

std::vector<std::array<bool, 2>> held_nodes(const fem::Problem<2>& problem) {
  std::vector<std::array<bool, 2>> held(problem.mesh.nodes.size(), {false, false});
  for (const fem::PrescribedDof<2>& item : problem.prescribed) {
    if (item.dof == fem::Dof::w || !problem.mesh.has_nodes_on(item.on)) continue;
    for (const int node : problem.mesh.nodes_on(item.on))
      held[static_cast<std::size_t>(node)][item.dof == fem::Dof::u1 ? 0 : 1] = true;
  }
  return held;
}

std::vector<std::array<bool, 2>> carried_nodes(const fem::Problem<2>& problem) {
  std::vector<std::array<bool, 2>> carried = held_nodes(problem);
  for (const auto& [one, other] : fem::joined_nodes(problem))
    carried[static_cast<std::size_t>(one)] = carried[static_cast<std::size_t>(other)] = {true, true};
  return carried;
}

std::vector<std::optional<double>> given_at(const fem::Problem<2>& problem, fem::Dof dof, double time) {
  std::vector<std::optional<double>> given(problem.mesh.nodes.size());
  for (const fem::PrescribedDof<2>* const item : fem::in_precedence(problem)) {
    if (item->dof != dof || !problem.mesh.has_nodes_on(item->on)) continue;
    for (const int node : problem.mesh.nodes_on(item->on)) {
      std::optional<double>& value = given[static_cast<std::size_t>(node)];
      if (value) continue;
      const Eigen::Vector2d& place = problem.mesh.nodes[static_cast<std::size_t>(node)];
      value = item->value.at(time) * (item->profile ? item->profile(place) : 1.0);
    }
  }
  return given;
}

Held held_along(const std::vector<OutlineEdge>& edges, const std::vector<std::array<bool, 2>>& held) {
  constexpr double kAlong = 1e-6;
  Held result;
  for (const OutlineEdge& edge : edges) {
    for (std::size_t i = 0; i < 2; ++i) {
      const bool here =
          std::ranges::all_of(edge.nodes, [&](int node) { return held[static_cast<std::size_t>(node)][i]; });
      result.all[i] = result.all[i] && here;
      if (std::abs(edge.normal(static_cast<Eigen::Index>(i))) > kAlong) result.normal = result.normal && here;
    }
  }
  return result;
}

}  // namespace polargrain::app
