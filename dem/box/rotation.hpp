// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "common/cosserat.hpp"

namespace polargrain::dem {

// Rotations, with the same bits on every processor (common/elementary_functions.hpp).

/// The rotation of the plane by an angle, counter-clockwise, rad.
Eigen::Matrix2d rotation_by(double angle);

/// The rotation by |vector| about the axis of `vector`, right-handed, rad (Rodrigues).
Eigen::Matrix3d rotation_by(const Eigen::Vector3d& vector);

/// The vector of a rotation by less than half a turn, rad: rotation_by gives the rotation back.
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation);

/// The vector w of the skew part of a matrix: (a - a^T) / 2 x = w cross x; in the plane its component along e_3.
template <int dim>
typename Cosserat<dim>::Rotation axial(const typename Cosserat<dim>::Gradient& a) {
  typename Cosserat<dim>::Rotation w;
  for (int k = 0; k < Cosserat<dim>::rotations; ++k) {
    const int i = (Cosserat<dim>::axis(k) + 1) % 3;
    const int j = (i + 1) % 3;
    w(k) = 0.5 * (a(j, i) - a(i, j));
  }
  return w;
}

/// R of the polar decomposition a = R U, det a > 0, by Newton's iteration (Higham 1986).
Eigen::Matrix3d rotation_of(const Eigen::Matrix3d& a);

/// a = Q T with a rotation Q and an upper triangular T whose diagonal is positive; det a > 0.
struct TriangularParts {
  Eigen::Matrix3d rotation;
  Eigen::Matrix3d triangular;
};
TriangularParts triangular_parts(const Eigen::Matrix3d& a);

}  // namespace polargrain::dem
