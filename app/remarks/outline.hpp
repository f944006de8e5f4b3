// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fem/solver/problem.hpp"

namespace polargrain::app {

/// A side of the outline: an edge of the plane, straight from corner to corner, or a face of space, a polygon of its nodes.
template <int dim>
struct OutlineSide {
  using Place = typename Cosserat<dim>::Place;

  int element;
  int number;                      ///< of the side among those of the element
  std::vector<int> nodes;          ///< corners, then middle nodes
  std::vector<int> corners;        ///< in space counter-clockwise seen from outside
  std::vector<std::string> names;  ///< boundaries that it belongs to
  Place centre;                    ///< mean of its corners, m
  Place normal;                    ///< outward, of length one
  double size;                     ///< m; in space m2
};

/// A side of an element, on the outline or not; in no boundary.
template <int dim>
OutlineSide<dim> side_at(const fem::Mesh<dim>& mesh, const fem::BoundarySide& side);

/// All sides of one element alone, in the order of the elements and their sides.
template <int dim>
std::vector<OutlineSide<dim>> outline_of(const fem::Mesh<dim>& mesh);

/// Those that are in no boundary.
template <int dim>
std::vector<OutlineSide<dim>> without_names(std::vector<OutlineSide<dim>> sides) {
  std::erase_if(sides, [](const OutlineSide<dim>& side) { return !side.names.empty(); });
  return sides;
}

/// The sides of a boundary, which may lie inside of the body too. Without a name: the sides of the outline that are in no boundary.
template <int dim>
std::vector<OutlineSide<dim>> sides_of(const fem::Mesh<dim>& mesh, const std::string& boundary);

/// By node: whether the displacement along each axis is prescribed there.
template <int dim>
using HeldNodes = std::vector<std::array<bool, static_cast<std::size_t>(dim)>>;

/// Whether displacements that are prescribed to move count as held.
enum class Movers { held, left_out };

template <int dim>
HeldNodes<dim> held_nodes(const fem::Problem<dim>& problem, Movers movers = Movers::held);

/// The same, and all where an interface, a beam or an anchor takes hold: it carries forces that no support shows.
template <int dim>
HeldNodes<dim> carried_nodes(const fem::Problem<dim>& problem);

/// By node: the displacement that the case gives it at a time, m.
template <int dim>
std::vector<std::optional<double>> given_at(const fem::Problem<dim>& problem, fem::Dof dof, double time);

/// The displacements that no side leaves free: along each axis at every node of all sides, and along the normal of each side.
template <int dim>
struct Held {
  std::array<bool, static_cast<std::size_t>(dim)> all;
  bool normal = true;
};
template <int dim>
Held<dim> held_along(const std::vector<OutlineSide<dim>>& sides, const HeldNodes<dim>& held);

/// The one axis along which the body is held at both of its ends, as in plane strain; -1 where there is no such one, or several.
int axis_of_plane_strain(const fem::Problem<3>& problem);

}  // namespace polargrain::app
