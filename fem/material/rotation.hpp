// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/increment.hpp"
#include "common/response.hpp"

namespace polargrain::fem {

/// A step of large deformation as a law takes it (docs/theory/solver.md, small and large deformation). The step carries
/// the shape at its start by F = I + h = R U. The law first follows the stretch U, in the axes of the start. R then turns
/// all that the law answers and remembers. So a law is exactly objective: with F' = Q F it answers Q s Q^T.
struct StretchAndTurn {
  /// The law takes it as an increment of small deformation: h = 2 (U - I) (U + I)^-1, which is symmetric; the
  /// micro-rotation less the angle of R; the curvature about the middle of the stretch.
  Increment stretch;
  double angle = 0.0;  ///< of R, rad, counter-clockwise, from -pi to pi
};

/// An increment of small deformation is a stretch as it is, and turns nothing.
StretchAndTurn stretch_and_turn(const Increment& increment);

/// Angle (rad, counter-clockwise) of the rotation in the polar decomposition of I + h.
double rotation_angle(const Increment& increment);

/// A vector of the plane turned by an angle.
Eigen::Vector2d rotated(const Eigen::Vector2d& vector, double angle);

/// A stress or strain vector (order of common/increment.hpp) turned with the material: s' = R s R^T, m' = R m.
Vector7 rotated(const Vector7& components, double angle);

/// The tangent between stresses and strains that are both turned.
Matrix7 rotated(const Matrix7& tangent, double angle);

/// The answer with stress and tangent turned.
Response rotated(Response response, double angle);

}  // namespace polargrain::fem
