// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/mesh/mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <algorithm>
#include <set>

#include "common/error.hpp"
#include "fem/element/kinematics.hpp"

namespace polargrain::fem {

std::vector<int> Mesh::edge_nodes(const Edge& edge) const {
  const Element& element = elements.at(static_cast<std::size_t>(edge.element));
  std::vector<int> numbers = element.type->side_nodes(edge.side);
  for (int& number : numbers) number = element.nodes[static_cast<std::size_t>(number)];
  return numbers;
}

bool Mesh::has_nodes_on(const std::string& name) const {
  return boundaries.contains(name) || node_sets.contains(name);
}

std::vector<int> Mesh::nodes_on(const std::vector<std::string>& names) const {
  std::set<int> nodes;
  for (const std::string& name : names) {
    const std::vector<int> found = nodes_on(name);
    nodes.insert(found.begin(), found.end());
  }
  return {nodes.begin(), nodes.end()};
}

std::vector<int> Mesh::nodes_on(const std::string& name) const {
  std::vector<int> found;
  if (const auto set = node_sets.find(name); set != node_sets.end()) {
    found = set->second;
  } else if (const auto boundary = boundaries.find(name); boundary != boundaries.end()) {
    for (const Edge& edge : boundary->second) {
      for (const int node : edge_nodes(edge)) found.push_back(node);
    }
  } else {
    throw RunError(fmt::format("the mesh has no boundary or node set '{}'; it has {}", name,
                               fmt::join(boundary_and_node_set_names(), ", ")));
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::vector<std::string> Mesh::boundary_and_node_set_names() const {
  std::vector<std::string> names;
  for (const auto& [name, edges] : boundaries) names.push_back(name);
  for (const auto& [name, numbers] : node_sets) names.push_back(name);
  return names;
}

Eigen::MatrixX2d Mesh::element_positions(int element) const {
  const std::vector<int>& numbers = elements.at(static_cast<std::size_t>(element)).nodes;
  Eigen::MatrixX2d positions(static_cast<Eigen::Index>(numbers.size()), 2);
  for (std::size_t a = 0; a < numbers.size(); ++a) {
    positions.row(static_cast<Eigen::Index>(a)) = nodes[static_cast<std::size_t>(numbers[a])].transpose();
  }
  return positions;
}

std::vector<std::string> distorted_elements(const Mesh& mesh) {
  std::vector<std::string> messages;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const ElementType& type = *mesh.elements[e].type;
    const Eigen::MatrixX2d positions = mesh.element_positions(static_cast<int>(e));
    // Corners bound the determinant of straight-sided elements; the points are where it is used.
    std::vector<Eigen::Vector2d> places(type.node_positions.begin(),
                                        type.node_positions.begin() + type.corners);
    for (const QuadraturePoint& point : type.quadrature) places.push_back(point.position);
    for (const Eigen::Vector2d& place : places) {
      const ShapeFunctions shape = type.shape_functions(place);
      const double determinant = jacobian(positions, shape).determinant();
      if (determinant > 0.0) continue;
      const Eigen::Vector2d where = positions.transpose() * shape.value;
      messages.push_back(fmt::format(
          "element {} ({}) is inverted or degenerate at ({:.6g}, {:.6g}): its Jacobian is {:.3g}, it "
          "must be positive; check the order of its nodes (counter-clockwise) and its shape",
          e, type.name, where(0), where(1), determinant));
      break;
    }
  }
  return messages;
}

}  // namespace polargrain::fem
