// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

namespace polargrain::fem {

/// The matrix of the cross product: cross(a) b = a x b.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a);
/// The vector of the skew part of a matrix: cross_matrix(axial(m)) = (m - m^T) / 2.
Eigen::Vector3d axial(const Eigen::Matrix3d& m);

/// exp[v]x, the rotation by |v| rad about v.
Eigen::Matrix3d rotation_by(const Eigen::Vector3d& vector);
/// The vector of a rotation by less than pi, rad.
Eigen::Vector3d vector_of(const Eigen::Matrix3d& rotation);
/// The vector of exp[after]x exp[before]x, of the turns of both one after the other: of those that differ by whole turns the
/// nearest to the sum.
Eigen::Vector3d composed(const Eigen::Vector3d& after, const Eigen::Vector3d& before);
/// J with exp[-v] d exp[v] = [J dv]x, and its inverse.
Eigen::Matrix3d right_jacobian(const Eigen::Vector3d& vector);
Eigen::Matrix3d inverse_right_jacobian(const Eigen::Vector3d& vector);

/// F = I + h = R U in space, with all that a step of large deformation needs of it. Found by the eigenvalues of the strain
/// of Green, of which small strains lose no digits.
class PolarDecomposition {
 public:
  explicit PolarDecomposition(const Eigen::Matrix3d& h);

  Eigen::Matrix3d rotation;       ///< R
  Eigen::Vector3d vector;         ///< of R, rad
  Eigen::Matrix3d half_way_back;  ///< R^(-1/2)
  Eigen::Matrix3d strain;         ///< 2 (U - I) (U + I)^-1
  Eigen::Matrix3d inverse;        ///< (U + I)^-1
  Eigen::Matrix3d stretch;        ///< U

  /// The parts of a change R^T dF = [spin]x U + dU.
  struct Change {
    Eigen::Vector3d spin;     ///< R^T dR, in the axes of the start
    Eigen::Matrix3d stretch;  ///< dU, symmetric
  };
  [[nodiscard]] Change change(const Eigen::Matrix3d& turned_back) const;

 private:
  Eigen::Array3d stretches_;
  Eigen::Matrix3d axes_;
};

}  // namespace polargrain::fem
