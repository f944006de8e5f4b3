// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "fem/element/element_type.hpp"

namespace polargrain::fem {

struct Element {
  const ElementType* type;  ///< never null; element types live as long as the program
  std::vector<int> nodes;   ///< type->nodes numbers into Mesh::nodes, in the order of ElementType
};

/// Side `side` of element `element`, seen from inside the body; the outward normal is to the right of the way
/// from the first corner to the second.
struct Edge {
  int element;
  int side;
};

/// A plane mesh, as a plain value. Names are the user's; one name may not be both a boundary and a node set.
struct Mesh {
  std::vector<Eigen::Vector2d> nodes;  ///< positions, m
  std::vector<Element> elements;
  std::map<std::string, std::vector<Edge>> boundaries;  ///< named parts of the boundary
  std::map<std::string, std::vector<int>> regions;      ///< named sets of elements
  std::map<std::string, std::vector<int>> node_sets;    ///< named sets of nodes

  /// Global nodes of an edge: first corner, second corner, then the middle node if there is one.
  [[nodiscard]] std::vector<int> edge_nodes(const Edge& edge) const;

  /// Positions of the nodes of an element, a row a node.
  [[nodiscard]] Eigen::MatrixX2d element_positions(int element) const;

  [[nodiscard]] bool has_nodes_on(const std::string& name) const;
  /// Nodes of the boundary or node set `name`, ascending, each once.
  /// @throws RunError when nothing has that name.
  [[nodiscard]] std::vector<int> nodes_on(const std::string& name) const;

  /// The same of several places: a node that lies on two of them stands there once.
  [[nodiscard]] std::vector<int> nodes_on(const std::vector<std::string>& names) const;

  /// Names that nodes_on knows, for messages.
  [[nodiscard]] std::vector<std::string> boundary_and_node_set_names() const;
};

/// Elements whose Jacobian is not positive at some integration point or corner, one message each that names
/// the element, the place and the determinant.
std::vector<std::string> distorted_elements(const Mesh& mesh);

}  // namespace polargrain::fem
