// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <vector>

#include "fem/element/element_type.hpp"
#include "fem/mesh/mesh.hpp"

namespace polargrain::fem {

/// An integration point of an interface.
template <int dim>
struct InterfacePoint {
  typename Cosserat<dim>::Place place;   ///< m
  double area;                           ///< m^2; in the plane m
  Eigen::VectorXd shape;                 ///< N of the nodes of one side
  Eigen::VectorXd corner_shape;          ///< N of its corners alone, linear along edges: of pore pressures
  Eigen::Matrix<double, dim, dim> axes;  ///< a row an axis: tangents first, the normal from side a to b last
};

/// Integration points of an interface of zero thickness on one face.
///
/// Lines: at the nodes (Simpson, trapezoid), which leaves pairs of nodes uncoupled: Gauss points let the stress ahead of the
/// tip of a gap oscillate. Faces with four or eight nodes: 3 x 3 Lobatto points, since nodal weights of eight-node
/// faces are negative at the corners. Faces with six nodes: six inner points of degree 4.
/// @param positions of the nodes of side a, a row a node, in the order of `type`; the normal points out of the element of
/// side a. In the plane the tangent is (n2, -n1).
template <int dim>
std::vector<InterfacePoint<dim>> interface_points(const ElementType<dim - 1>& type,
                                                  const VectorRows<dim>& positions);

}  // namespace polargrain::fem
