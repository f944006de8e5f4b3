// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/linear_contact.hpp"

#include <cmath>

namespace polargrain::dem {

LinearContact::LinearContact(const Contact& contact, const Eigen::Matrix2d& frame) {
  const Eigen::Vector2d branch = frame * contact.branch;
  const Eigen::Vector2d n = branch.normalized();
  const Eigen::Vector2d t(-n.y(), n.x());

  stiffness.setZero();
  stiffness.topLeftCorner<2, 2>() = contact.normal_stiffness * n * n.transpose();
  // The compressive normal force falls by k_n as the contact opens, and friction falls with it.
  if (contact.sliding())
    stiffness.topLeftCorner<2, 2>() -= std::copysign(contact.friction, contact.tangential_force()) *
                                       contact.normal_stiffness * t * n.transpose();
  else
    stiffness.topLeftCorner<2, 2>() += contact.tangential_stiffness * t * t.transpose();
  if (!contact.rolling_at_limit)
    stiffness(2, 2) = contact.rolling_stiffness;
  else if (const double normal_force = contact.normal_force(); normal_force > 0.0)
    stiffness.row(2).head<2>() = -contact.moment / normal_force * contact.normal_stiffness * n.transpose();

  // (v_B - v_A) . t - r_A w_A - r_B w_B (D.1); spins move the surfaces along t only.
  motions.setZero();
  motions.topLeftCorner<2, 2>() = -Eigen::Matrix2d::Identity();
  motions.block<2, 1>(0, 2) = -contact.arm_first * t;
  motions.block<2, 2>(0, 3) = Eigen::Matrix2d::Identity();
  motions.block<2, 1>(0, 5) = -contact.arm_second * t;
  motions(2, 2) = -1.0;
  motions(2, 5) = 1.0;

  // opening_j = l_i eps_ij, rotation = l_i kappa_i (C.6), and the slip of unequal radii (C.8).
  affine.setZero();
  affine(0, k11) = branch.x();
  affine(0, k21) = branch.y();
  affine(1, k12) = branch.x();
  affine(1, k22) = branch.y();
  affine(2, kCurvature1) = branch.x();
  affine(2, kCurvature2) = branch.y();
  affine.block<2, 2>(0, kCurvature1) =
      -0.5 * (contact.arm_second - contact.arm_first) * t * branch.transpose();
}

}  // namespace polargrain::dem
