// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "common/increment.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// The law of one contact linearised where it stands (docs/theory/grains.md, C.7): from the opening (two
/// components of the displacement of the second surface against the first, and the rotation of the second
/// grain against the first) to the change of (force, moment) on the first grain.
///
/// A sliding contact keeps f_t = +-mu f_n, a rolling contact at its limit M = +-(limit / f_n) f_n; either
/// makes the law non-symmetric. Along an increment contacts near a limit do so in part (near_limit.hpp). The rolling stiffness of models that do not tell it (all but li_chu
/// and epsd2) counts as zero.
struct LinearContact {
  static constexpr int kMotions = 3;  ///< of a grain, as many as openings
  Eigen::Matrix3d stiffness;          ///< N/m, N; N, N m/rad
  Eigen::Matrix<double, 3, 6>
      motions;  ///< opening from (u1, u2, rotation) of the first, then the second grain
  Eigen::Matrix<double, 3, 7>
      affine;  ///< opening from a Cosserat strain; transposed: V stress from the force

  /// @param frame turns vectors of the contact into the frame of the strain
  /// @param strain size of the increment that the tangent is for; 0: of the next infinitesimal one
  LinearContact(const Contact& contact, const Eigen::Matrix2d& frame, double strain = 0.0);
};

}  // namespace polargrain::dem
