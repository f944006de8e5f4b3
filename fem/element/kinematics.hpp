// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/cosserat.hpp"
#include "common/increment.hpp"
#include "fem/element/element_type.hpp"

namespace polargrain::fem {

/// How the micro-rotation at a point comes about.
enum class Continuum {
  cosserat,  ///< a field of its own
  cauchy     ///< the rotation of the continuum; curvature is zero, so is every part of w
};

/// An integration point of an element, in place.
template <int dim>
struct PointGeometry {
  typename Cosserat<dim>::Place position;  ///< m
  double volume;                           ///< m^3; in the plane per unit thickness, m^2
  Eigen::VectorXd shape;                   ///< N_a
  VectorRows<dim> gradient;                ///< dN_a / dx_j, 1/m
  /// Added to each h_ii alike: 1/dim of (mean over the element - value here) of the gradients; empty unless the element has
  /// mean dilatation.
  VectorRows<dim> dilatation_correction;
};

/// Jacobian d x_i / d xi_j at a place of the reference element. @param nodes positions, a row a node.
template <int dim>
typename Cosserat<dim>::Gradient jacobian(const VectorRows<dim>& nodes, const ShapeFunctions<dim>& shape);

/// The integration points of one element. @param nodes positions, a row a node.
template <int dim>
std::vector<PointGeometry<dim>> point_geometries(const ElementType<dim>& type, const VectorRows<dim>& nodes);

/// The increment that the point feels (docs/theory.md, A.1). @param dofs the unknowns of each node in turn.
template <int dim>
Increment<dim> increment_at(const PointGeometry<dim>& point, Continuum continuum,
                            const Eigen::VectorXd& dofs);

/// The same in large deformation: gradients about the start of the step (Configuration::start).
/// @param start the geometry at the start of the step @param dofs their changes over the step
/// @param dilatation by which lengths are multiplied so that the volume ratio is that of the element: 1 but for
/// elements with mean dilatation (F-bar: de Souza Neto and others 1996)
template <int dim>
Increment<dim> large_increment_at(const PointGeometry<dim>& start, Continuum continuum,
                                  const Eigen::VectorXd& dofs, double dilatation);

/// A row a component of Cosserat<dim>, a column an unknown of the element.
template <int dim>
using StrainMatrix = Eigen::Matrix<double, Cosserat<dim>::components, Eigen::Dynamic>;

/// B with strain = B dofs (docs/theory.md, A.6): eps_ij = u_j,i - e_ijk w_k, kappa_ij = w_j,i; unscaled.
template <int dim>
StrainMatrix<dim> strain_matrix(const PointGeometry<dim>& point, Continuum continuum);

}  // namespace polargrain::fem
