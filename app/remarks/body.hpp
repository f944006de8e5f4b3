// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fem/solver/problem.hpp"

namespace polargrain::app {

/// Sizes of a mesh, m.
struct Body {
  Eigen::Vector2d least, largest;  ///< corners of the box around it; in space along x1 and x2
  std::vector<double> elements;    ///< square root of the area of each, cube root of the volume in space
  double mean_element = 0.0;       ///< side of an element of the mean area or volume, m
  std::vector<double> sides;       ///< of the box around it, along each axis
  double bottom = 0.0;             ///< its lowest and highest point along the last axis
  double top = 0.0;

  [[nodiscard]] Eigen::Vector2d size() const { return largest - least; }
  [[nodiscard]] double smaller_side() const { return *std::ranges::min_element(sides); }
};

template <int dim>
Body body_of(const fem::Mesh<dim>& mesh);

/// An edge of the outline.
struct OutlineEdge {
  int element;
  std::vector<int> nodes;
  Eigen::Vector2d centre;
  Eigen::Vector2d normal;  ///< outward, of length one
  double length;           ///< m
};

/// The edges of a boundary; of the parts of the outline that are in no boundary where the name is empty.
std::vector<OutlineEdge> edges_of(const fem::Mesh<2>& mesh, const std::string& boundary);

/// By node: whether u1 and u2 are prescribed there, by a support or a movement.
std::vector<std::array<bool, 2>> held_nodes(const fem::Problem<2>& problem);

/// The same, and both where an interface, a beam or an anchor takes hold: it carries forces that no support shows.
std::vector<std::array<bool, 2>> carried_nodes(const fem::Problem<2>& problem);

/// By node: the displacement that the case gives it at a time, m.
std::vector<std::optional<double>> given_at(const fem::Problem<2>& problem, fem::Dof dof, double time);

/// Which of the normal and the two displacements no edge leaves free: u1, u2 of every node of all edges, and the
/// displacement along the normal of each edge.
struct Held {
  std::array<bool, 2> all{true, true};
  bool normal = true;
};
Held held_along(const std::vector<OutlineEdge>& edges, const std::vector<std::array<bool, 2>>& held);

}  // namespace polargrain::app
