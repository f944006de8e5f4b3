// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "common/record.hpp"

namespace polargrain {

/// The increment of a cell of grains in space: the change over a load step at its point, about the
/// start of the step (docs/theory/continuum.md, A.7). The components known to finite elements of the plane are put here in
/// one place (common/plane_in_space.hpp).
struct CellIncrement {
  /// h(i,j) = d u_i / d x_j, dimensionless.
  Eigen::Matrix3d displacement_gradient = Eigen::Matrix3d::Zero();
  /// Change of the micro-rotation, a vector along its axis, right-handed, rad. For grains whose rotations are free
  /// it says nothing.
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();
  /// kappa(i,j) = d w_i / d x_j, rad/m: like the displacement gradient, first the component, then the direction.
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();
};

template <RecordOf<CellIncrement> Record, class Visit>
void describe(Record& increment, Visit&& visit) {
  visit(FieldNotes{"h", "1", "displacement gradient, h_ij = d u_i / d x_j", "11 12 13 21 22 23 31 32 33"},
        increment.displacement_gradient);
  visit(FieldNotes{"w", "rad", "micro-rotation about e_i, right-handed", "1 2 3"}, increment.rotation);
  visit(FieldNotes{"k", "rad/m", "curvature, k_ij = d w_i / d x_j", "11 12 13 21 22 23 31 32 33"},
        increment.curvature);
}

}  // namespace polargrain
