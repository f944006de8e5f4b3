// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/element/corner_shape.hpp"

#include <Eigen/LU>

namespace polargrain::fem {
namespace {

/// Linear in the area or volume coordinates.
template <int dim>
ShapeFunctions<dim> of_simplex(const Eigen::Matrix<double, dim, 1>& position) {
  ShapeFunctions<dim> shape{Eigen::VectorXd(dim + 1), VectorRows<dim>::Zero(dim + 1, dim)};
  shape.value << 1.0 - position.sum(), position;
  shape.derivative.row(0).setConstant(-1.0);
  shape.derivative.bottomRows(dim).setIdentity();
  return shape;
}

/// Products of (1 + xi_i xi) / 2 along the axes.
template <int dim>
ShapeFunctions<dim> of_cuboid(const ElementType<dim>& type, const Eigen::Matrix<double, dim, 1>& position) {
  ShapeFunctions<dim> shape{Eigen::VectorXd(type.corners), VectorRows<dim>(type.corners, dim)};
  for (int a = 0; a < type.corners; ++a) {
    const Eigen::Matrix<double, dim, 1>& corner = type.node_positions[static_cast<std::size_t>(a)];
    const Eigen::Matrix<double, dim, 1> factors =
        0.5 * (Eigen::Matrix<double, dim, 1>::Ones() + corner.cwiseProduct(position));
    shape.value(a) = factors.prod();
    for (int i = 0; i < dim; ++i) {
      Eigen::Matrix<double, dim, 1> changed = factors;
      changed(i) = 0.5 * corner(i);
      shape.derivative(a, i) = changed.prod();
    }
  }
  return shape;
}

}  // namespace

template <int dim>
ShapeFunctions<dim> corner_shape_functions(const ElementType<dim>& type,
                                           const Eigen::Matrix<double, dim, 1>& position) {
  // A line has two corners too, at -1 and 1.
  if constexpr (dim > 1)
    if (type.corners == dim + 1) return of_simplex<dim>(position);
  return of_cuboid<dim>(type, position);
}

template <int dim>
std::vector<ShapeFunctions<dim>> corner_shapes_in_place(const ElementType<dim>& type,
                                                        const VectorRows<dim>& nodes) {
  std::vector<ShapeFunctions<dim>> shapes;
  for (const QuadraturePoint<dim>& place : type.quadrature) {
    ShapeFunctions<dim>& shape = shapes.emplace_back(corner_shape_functions<dim>(type, place.position));
    shape.derivative *= jacobian<dim>(nodes, type.shape_functions(place.position)).inverse();
  }
  return shapes;
}

template ShapeFunctions<1> corner_shape_functions<1>(const ElementType<1>&,
                                                     const Eigen::Matrix<double, 1, 1>&);
template ShapeFunctions<2> corner_shape_functions<2>(const ElementType<2>&,
                                                     const Eigen::Matrix<double, 2, 1>&);
template ShapeFunctions<3> corner_shape_functions<3>(const ElementType<3>&,
                                                     const Eigen::Matrix<double, 3, 1>&);
template std::vector<ShapeFunctions<2>> corner_shapes_in_place<2>(const ElementType<2>&,
                                                                  const VectorRows<2>&);
template std::vector<ShapeFunctions<3>> corner_shapes_in_place<3>(const ElementType<3>&,
                                                                  const VectorRows<3>&);

}  // namespace polargrain::fem
