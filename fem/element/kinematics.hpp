// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/increment.hpp"
#include "fem/element/element_type.hpp"

namespace polargrain::fem {

/// How the micro-rotation at a point comes about.
enum class Continuum {
  cosserat,  ///< a field of its own
  cauchy     ///< the rotation of the continuum; curvature is zero, so is every part of w
};

/// An integration point of an element in space.
struct PointGeometry {
  Eigen::Vector2d position;   ///< m
  double volume;              ///< per unit thickness, m^2
  Eigen::VectorXd shape;      ///< N_a
  Eigen::MatrixX2d gradient;  ///< dN_a / dx_j, 1/m
  /// Added to h11 and h22 alike: half of (mean over the element - value here) of the gradients; empty unless
  /// the element has mean dilatation.
  Eigen::MatrixX2d dilatation_correction;
};

/// Jacobian d x_i / d xi_j at a place of the reference element. @param nodes positions, a row a node.
Eigen::Matrix2d jacobian(const Eigen::MatrixX2d& nodes, const ShapeFunctions& shape);

/// The integration points of one element. @param nodes positions, a row a node.
std::vector<PointGeometry> point_geometries(const ElementType& type, const Eigen::MatrixX2d& nodes);

/// The increment that the point feels (docs/theory.md, A.1). @param dofs u1, u2, w of each node in turn.
Increment increment_at(const PointGeometry& point, Continuum continuum, const Eigen::VectorXd& dofs);

/// The same in large deformation: gradients about the start of the step (Configuration::start).
/// @param start the geometry at the start of the step @param dofs their changes over the step
/// @param dilatation by which lengths are multiplied so that the volume ratio is that of the element: 1 but for
/// elements with mean dilatation (F-bar: de Souza Neto and others 1996)
Increment large_increment_at(const PointGeometry& start, Continuum continuum, const Eigen::VectorXd& dofs,
                             double dilatation);

/// B with strain = B dofs (docs/theory.md, A.6), 7 rows in the order of common/increment.hpp; unscaled.
Eigen::Matrix<double, 7, Eigen::Dynamic> strain_matrix(const PointGeometry& point, Continuum continuum);

}  // namespace polargrain::fem
