// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace polargrain::fem {

/// A place of the reference element and its share of the reference area.
struct QuadraturePoint {
  Eigen::Vector2d position;
  double weight;
};

/// Values of the shape functions of one element at one place.
struct ShapeFunctions {
  Eigen::VectorXd value;        ///< N_a
  Eigen::MatrixX2d derivative;  ///< dN_a / d xi_i, a row a node
};

/// A family of isoparametric elements: interpolation, quadrature and the data that neighbours need. Nodes run
/// counter-clockwise, corners first, then the middle nodes of the sides in the order of the sides (the order
/// of VTK). All of (u1, u2, w) are interpolated alike.
struct ElementType {
  std::string name;
  int nodes;
  int corners;
  int vtk_cell_type;
  std::vector<QuadraturePoint> quadrature;
  /// Reference coordinates of the nodes, in order.
  std::vector<Eigen::Vector2d> node_positions;
  ShapeFunctions (*shape_functions)(const Eigen::Vector2d& position);
  /// Replace the volume strain at the points by its mean over the element: cures volume locking of low-order
  /// elements.
  bool mean_dilatation;

  /// Nodes of side `side` in local numbers: first corner, second corner, then the middle node if there is
  /// one.
  [[nodiscard]] std::vector<int> side_nodes(int side) const;
};

/// @param name one of element_names(), for example "Q8R".
/// @throws RunError naming the known elements when there is none of that name.
const ElementType& element_type(std::string_view name);

std::vector<std::string> element_names();

}  // namespace polargrain::fem
