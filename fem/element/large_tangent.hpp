// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/response.hpp"
#include "fem/element/kinematics.hpp"

namespace polargrain::fem {

/// Derivative of a point's nodal forces B^T s volume with respect to the nodal values where the mesh moves
/// along (updated Lagrangian): the strain refers to the middle of the step, the forces to its end, and the
/// stress at the start turns with the material (rotation.hpp) before the strain adds to it.
/// @param increment that the material was given, about the geometry of `middle`. @param start_stress at the
/// start of the step. Where the law is not elastic, how it hands on a turn of that stress is taken as if it
/// were; the error is of the order of the strain of the step and costs iterations only.
Eigen::MatrixXd large_tangent(const PointGeometry& end, const PointGeometry& middle,
                              const Increment& increment, Continuum continuum, const Response& response,
                              const Vector7& start_stress);

}  // namespace polargrain::fem
