// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "common/cosserat.hpp"
#include "fem/element/element_type.hpp"

namespace polargrain::fem {

template <int dim>
struct Element {
  const ElementType<dim>* type;  ///< never null; element types live as long as the program
  std::vector<int> nodes;        ///< type->nodes numbers into Mesh::nodes, in the order of ElementType
};

/// Side `side` of element `element`: an edge in the plane, a face in space, seen from inside the body (ElementType::sides).
struct BoundarySide {
  int element;
  int side;
};

/// A mesh, as a plain value. Names are the user's; one name may not be both a boundary and a node set.
template <int dim>
struct Mesh {
  std::vector<typename Cosserat<dim>::Place> nodes;  ///< positions, m
  std::vector<Element<dim>> elements;
  std::map<std::string, std::vector<BoundarySide>> boundaries;  ///< named parts of the boundary
  std::map<std::string, std::vector<int>> regions;              ///< named sets of elements
  std::map<std::string, std::vector<int>> node_sets;            ///< named sets of nodes

  [[nodiscard]] const ElementSide<dim>& side_of(const BoundarySide& side) const;
  /// Global nodes of a side: the corners, then the middle nodes if there are any.
  [[nodiscard]] std::vector<int> side_nodes(const BoundarySide& side) const;

  /// Positions of the nodes of an element, a row a node.
  [[nodiscard]] VectorRows<dim> element_positions(int element) const;

  [[nodiscard]] bool has_nodes_on(const std::string& name) const;
  /// Nodes of the boundary or node set `name`, ascending, each once.
  /// @throws RunError when nothing has that name.
  [[nodiscard]] std::vector<int> nodes_on(const std::string& name) const;

  /// The same of several places: a node that lies on two of them stands there once.
  [[nodiscard]] std::vector<int> nodes_on(const std::vector<std::string>& names) const;

  /// Names that nodes_on knows, for messages.
  [[nodiscard]] std::vector<std::string> boundary_and_node_set_names() const;
};

/// "(x, y)" or "(x, y, z)" in m, for messages.
template <int dim>
std::string place_text(const Eigen::Matrix<double, dim, 1>& place);

/// Elements whose Jacobian is not positive at some integration point or corner, one message each that names
/// the element, the place and the determinant.
template <int dim>
std::vector<std::string> distorted_elements(const Mesh<dim>& mesh);

}  // namespace polargrain::fem
