// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "fem/element/element_type.hpp"

namespace polargrain::fem {

/// The nodal patterns, rigid motions aside, that do not strain an element with one integration point. Each unknown has the same.
struct HourglassModes {
  /// A row a node, a column a mode: orthogonal to constant and linear fields, 1 for a field that is the product of reference
  /// coordinates.
  Eigen::MatrixXd modes;
  /// Mean square of the strain of each mode times the volume, m (in the plane 1): times Young's modulus it is the stiffness of
  /// bending where sides are equal.
  Eigen::VectorXd weights;
};

/// After Flanagan and Belytschko (1981). @param type linear quadrilateral or hexahedron @param nodes positions, a row a node
template <int dim>
HourglassModes hourglass_modes(const ElementType<dim>& type, const VectorRows<dim>& nodes);

}  // namespace polargrain::fem
