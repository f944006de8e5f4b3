// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace polargrain::fem {

/// Vectors of the plane (2), of space (3) or along a line (1), a row each: positions or gradients of nodes.
template <int dim>
using VectorRows = Eigen::Matrix<double, Eigen::Dynamic, dim>;

/// A place of the reference element and its share of the reference volume.
template <int dim>
struct QuadraturePoint {
  Eigen::Matrix<double, dim, 1> position;
  double weight;
};

/// Values of the shape functions of one element at one place.
template <int dim>
struct ShapeFunctions {
  Eigen::VectorXd value;       ///< N_a
  VectorRows<dim> derivative;  ///< dN_a / d xi_i, a row a node
};

template <int dim>
struct ElementType;

/// A side of an element: an edge in the plane, a face in space.
template <int dim>
struct ElementSide {
  std::vector<int> nodes;            ///< local numbers, in the order of `type`
  const ElementType<dim - 1>* type;  ///< its own interpolation; its quadrature is that of loads
};

/// A family of isoparametric elements: interpolation, quadrature and the data that neighbours need. Nodes have the order
/// of VTK: corners first (in the plane counter-clockwise), then the middle nodes of the edges. All unknowns are interpolated
/// alike. With dim 1: the lines that are sides of plane elements.
template <int dim>
struct ElementType {
  std::string name;
  int nodes;
  int corners;
  int vtk_cell_type;
  std::vector<QuadraturePoint<dim>> quadrature;
  /// Reference coordinates of the nodes, in order.
  std::vector<Eigen::Matrix<double, dim, 1>> node_positions;
  ShapeFunctions<dim> (*shape_functions)(const Eigen::Matrix<double, dim, 1>& position);
  /// Replace the volume strain at the points by its mean over the element: cures volume locking of low-order
  /// elements.
  bool mean_dilatation;
  /// In the plane the outward normal is to the right of the way from the first corner of a side to the second. In space it
  /// is x,xi cross x,eta of the face's reference coordinates.
  std::vector<ElementSide<dim>> sides;
  /// Elements with one integration point: it stands for the mean over these places, of shape functions and gradients alike
  /// (Flanagan and Belytschko 1981). Patterns that it does not see need springs (solver/stabilisation.hpp).
  std::vector<QuadraturePoint<dim>> averaged = {};
};

/// @param name one of element_names(), for example "Q8R".
/// @throws RunError naming the known elements when no element has that name.
template <int dim>
const ElementType<dim>& element_type(std::string_view name);

template <int dim>
std::vector<std::string> element_names();

}  // namespace polargrain::fem
