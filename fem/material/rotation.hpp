// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <type_traits>

#include "common/increment.hpp"
#include "common/response.hpp"

namespace polargrain::fem {

/// A rotation: in the plane its angle (rad, counter-clockwise), in space its matrix.
template <int dim>
using Turn = std::conditional_t<dim == 2, double, Eigen::Matrix3d>;

/// A step of large deformation as a law takes it (docs/theory/solver.md, small and large deformation). The step carries
/// the shape at its start by F = I + h = R U. The law first follows the stretch U, in the axes of the start. R then turns
/// all that the law answers and remembers. So a law is exactly objective: with F' = Q F it answers Q s Q^T.
template <int dim>
struct StretchAndTurn {
  /// The law takes it as an increment of small deformation: h = 2 (U - I) (U + I)^-1, which is symmetric; the
  /// micro-rotation less the rotation of R; the curvature about the middle of the stretch.
  Increment<dim> stretch;
  Turn<dim> turn;  ///< R; in the plane from -pi to pi
};

/// The rotation that turns nothing, and the one that turns back.
template <int dim>
Turn<dim> no_turn() {
  if constexpr (dim == 2) {
    return 0.0;
  } else {
    return Eigen::Matrix3d::Identity();
  }
}
inline double inverse(double angle) {
  return -angle;
}
inline Eigen::Matrix3d inverse(const Eigen::Matrix3d& rotation) {
  return rotation.transpose();
}

/// An increment of small deformation is a stretch as it is, and turns nothing.
StretchAndTurn<2> stretch_and_turn(const Increment<2>& increment);
StretchAndTurn<3> stretch_and_turn(const Increment<3>& increment);

/// Angle (rad, counter-clockwise) of the rotation in the polar decomposition of I + h.
double rotation_angle(const Increment<2>& increment);
/// The same in space: the vector of the rotation, along its axis, rad.
Eigen::Vector3d rotation_vector(const Increment<3>& increment);

/// A vector of the plane turned by an angle.
Eigen::Vector2d rotated(const Eigen::Vector2d& vector, double angle);

/// A stress or strain vector (order of Cosserat) turned with the material: s' = R s R^T; m' = R m in the plane, in space
/// R m R^T.
Vector7 rotated(const Vector7& components, double angle);
Vector18 rotated(const Vector18& components, const Eigen::Matrix3d& rotation);

/// The tangent between stresses and strains that are both turned.
Matrix7 rotated(const Matrix7& tangent, double angle);
Matrix18 rotated(const Matrix18& tangent, const Eigen::Matrix3d& rotation);

/// The answer with stress and tangent turned.
template <int dim>
Response<dim> rotated(Response<dim> response, const std::type_identity_t<Turn<dim>>& turn) {
  response.stress = rotated(response.stress, turn);
  response.tangent = rotated(response.tangent, turn);
  return response;
}

}  // namespace polargrain::fem
