// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>

#include "common/response.hpp"
#include "fem/element/kinematics.hpp"

namespace polargrain::fem {

/// Derivative of a point's nodal forces B^T s volume with respect to the nodal values where the mesh moves
/// along (updated Lagrangian). The law follows the stretch of the step and its answer turns (rotation.hpp); the forces
/// belong to the end of the step. Exact for laws whose tangent is: the turn of a stress is never handed to a law.
/// @param start, end geometry of the point at both ends of the step @param increment that the material was given
/// @param places averaged_places at the end; empty where the point stands for itself
template <int dim>
Eigen::MatrixXd large_tangent(const PointGeometry<dim>& end, const PointGeometry<dim>& start,
                              const Increment<dim>& increment, Continuum continuum,
                              const Response<dim>& response, std::span<const PointGeometry<dim>> places = {});

/// How the strain that the law is given changes with the nodal values, in the axes of the end of the step.
/// @param is_averaged the point stands for averaged_places
template <int dim>
StrainMatrix<dim> large_strain_matrix(const PointGeometry<dim>& end, const PointGeometry<dim>& start,
                                      const Increment<dim>& increment, Continuum continuum, bool is_averaged);

/// The further stiffness of elements with mean dilatation: their mean gradients change with the shape of the element.
/// @param points of the element at the end of the step @param answers as many
template <int dim>
Eigen::MatrixXd mean_dilatation_stiffness(std::span<const PointGeometry<dim>> points,
                                          std::span<const Response<dim>> answers);

}  // namespace polargrain::fem
