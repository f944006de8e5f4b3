// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

namespace polargrain::dem {

// Rotations in space, with the same bits on every processor (common/elementary_functions.hpp).

/// The rotation by |vector| about the axis of `vector`, right-handed, rad (Rodrigues).
Eigen::Matrix3d rotation_by(const Eigen::Vector3d& vector);

/// The vector of a rotation by less than half a turn, rad: rotation_by gives the rotation back.
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation);

/// The vector w of the skew part of a matrix: (a - a^T) / 2 x = w cross x.
Eigen::Vector3d axial(const Eigen::Matrix3d& a);

/// R of the polar decomposition a = R U, det a > 0, by Newton's iteration (Higham 1986).
Eigen::Matrix3d rotation_of(const Eigen::Matrix3d& a);

/// a = Q T with a rotation Q and an upper triangular T whose diagonal is positive; det a > 0.
struct TriangularParts {
  Eigen::Matrix3d rotation;
  Eigen::Matrix3d triangular;
};
TriangularParts triangular_parts(const Eigen::Matrix3d& a);

}  // namespace polargrain::dem
