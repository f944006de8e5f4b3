// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/response.hpp"
#include "fem/element/kinematics.hpp"

namespace polargrain::fem {

/// Derivative of a point's nodal forces B^T s volume with respect to the nodal values where the mesh moves
/// along (updated Lagrangian): the strain refers to the middle of the step, the forces to its end, and the
/// stress turns with the material (rotation.hpp).
/// @param increment that the material was given, about the geometry of `middle`.
Eigen::MatrixXd large_tangent(const PointGeometry& end, const PointGeometry& middle,
                              const Increment& increment, Continuum continuum, const Response& response);

}  // namespace polargrain::fem
