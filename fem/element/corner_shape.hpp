// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "fem/element/kinematics.hpp"

namespace polargrain::fem {

/// Shape functions of the corners of an element alone, linear along its edges: for fields one degree below the displacements.
template <int dim>
ShapeFunctions<dim> corner_shape_functions(const ElementType<dim>& type,
                                           const Eigen::Matrix<double, dim, 1>& position);

/// The same at the integration points of an element in place, in their order: values and gradients by position (1/m). The
/// geometry is that of all nodes of the element. @param nodes positions, a row a node
template <int dim>
std::vector<ShapeFunctions<dim>> corner_shapes_in_place(const ElementType<dim>& type,
                                                        const VectorRows<dim>& nodes);

}  // namespace polargrain::fem
