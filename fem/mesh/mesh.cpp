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

template <int dim>
const ElementSide<dim>& Mesh<dim>::side_of(const BoundarySide& side) const {
  return elements.at(static_cast<std::size_t>(side.element))
      .type->sides.at(static_cast<std::size_t>(side.side));
}

template <int dim>
std::vector<int> Mesh<dim>::side_nodes(const BoundarySide& side) const {
  const Element<dim>& element = elements.at(static_cast<std::size_t>(side.element));
  std::vector<int> numbers = side_of(side).nodes;
  for (int& number : numbers) number = element.nodes[static_cast<std::size_t>(number)];
  return numbers;
}

template <int dim>
bool Mesh<dim>::has_nodes_on(const std::string& name) const {
  return boundaries.contains(name) || node_sets.contains(name);
}

template <int dim>
std::vector<int> Mesh<dim>::nodes_on(const std::vector<std::string>& names) const {
  std::set<int> nodes;
  for (const std::string& name : names) {
    const std::vector<int> found = nodes_on(name);
    nodes.insert(found.begin(), found.end());
  }
  return {nodes.begin(), nodes.end()};
}

template <int dim>
std::vector<int> Mesh<dim>::nodes_on(const std::string& name) const {
  std::vector<int> found;
  if (const auto set = node_sets.find(name); set != node_sets.end()) {
    found = set->second;
  } else if (const auto boundary = boundaries.find(name); boundary != boundaries.end()) {
    for (const BoundarySide& side : boundary->second) {
      for (const int node : side_nodes(side)) found.push_back(node);
    }
  } else {
    throw RunError(fmt::format("the mesh has no boundary or node set '{}'; it has {}", name,
                               fmt::join(boundary_and_node_set_names(), ", ")));
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

template <int dim>
std::vector<std::string> Mesh<dim>::boundary_and_node_set_names() const {
  std::vector<std::string> names;
  for (const auto& [name, edges] : boundaries) names.push_back(name);
  for (const auto& [name, numbers] : node_sets) names.push_back(name);
  return names;
}

template <int dim>
VectorRows<dim> Mesh<dim>::element_positions(int element) const {
  const std::vector<int>& numbers = elements.at(static_cast<std::size_t>(element)).nodes;
  VectorRows<dim> positions(static_cast<Eigen::Index>(numbers.size()), dim);
  for (std::size_t a = 0; a < numbers.size(); ++a) {
    positions.row(static_cast<Eigen::Index>(a)) = nodes[static_cast<std::size_t>(numbers[a])].transpose();
  }
  return positions;
}

template <int dim>
std::string place_text(const Eigen::Matrix<double, dim, 1>& place) {
  std::string text;
  for (int i = 0; i < dim; ++i) text += fmt::format("{}{:.6g}", i == 0 ? "(" : ", ", place(i));
  return text + ")";
}

template <int dim>
std::vector<std::string> distorted_elements(const Mesh<dim>& mesh) {
  std::vector<std::string> messages;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const ElementType<dim>& type = *mesh.elements[e].type;
    const VectorRows<dim> positions = mesh.element_positions(static_cast<int>(e));
    // Corners bound the determinant of straight-sided elements; the points are where it is used.
    std::vector<typename Cosserat<dim>::Place> places(type.node_positions.begin(),
                                                      type.node_positions.begin() + type.corners);
    for (const QuadraturePoint<dim>& point : type.quadrature) places.push_back(point.position);
    for (const typename Cosserat<dim>::Place& place : places) {
      const ShapeFunctions<dim> shape = type.shape_functions(place);
      const double determinant = jacobian<dim>(positions, shape).determinant();
      if (determinant > 0.0) continue;
      const typename Cosserat<dim>::Place where = positions.transpose() * shape.value;
      messages.push_back(fmt::format(
          "element {} ({}) is inverted or degenerate at {}: its Jacobian is {:.3g}, it "
          "must be positive; check the order of its nodes{} and its shape",
          e, type.name, place_text<dim>(where), determinant, dim == 2 ? " (counter-clockwise)" : ""));
      break;
    }
  }
  return messages;
}

template std::vector<std::string> distorted_elements<2>(const Mesh<2>& mesh);
template std::vector<std::string> distorted_elements<3>(const Mesh<3>& mesh);
template std::string place_text<2>(const Eigen::Vector2d& place);
template std::string place_text<3>(const Eigen::Vector3d& place);
template struct Mesh<2>;
template struct Mesh<3>;

}  // namespace polargrain::fem
