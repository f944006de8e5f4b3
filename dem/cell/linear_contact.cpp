// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/linear_contact.hpp"

#include <cmath>

#include "dem/cell/near_limit.hpp"

namespace polargrain::dem {
namespace {

double sliding_share(const Contact& contact, const WayOfSprings& way) {
  if (contact.sliding()) return 0.0;
  const double limit = contact.friction * std::max(0.0, contact.normal_force());
  return limit > 0.0 ? spring_share(std::abs(contact.tangential_force()), limit, contact.tangential_stiffness,
                                    way.slip)
                     : 1.0;
}

double rolling_share(const Contact& contact, const WayOfSprings& way) {
  if (contact.rolling_at_limit) return 0.0;
  return contact.rolling_limit > 0.0 ? spring_share(std::abs(contact.moment.z()), contact.rolling_limit,
                                                    contact.rolling_stiffness, way.turn)
                                     : 1.0;
}

}  // namespace

LinearContact::LinearContact(const Contact& contact, const Eigen::Matrix2d& frame, double strain) {
  const Eigen::Vector2d branch = frame * contact.branch.head<2>();
  const Eigen::Vector2d n = branch.normalized();
  const Eigen::Vector2d t(-n.y(), n.x());

  stiffness.setZero();
  stiffness.topLeftCorner<2, 2>() = contact.normal_stiffness * n * n.transpose();
  // The share that a spring no longer answers is the limit's: it falls with the compressive normal force, which falls by k_n as
  // the contact opens.
  const WayOfSprings way = WayOfSprings::of(strain, branch.norm());
  const double normal_force = contact.normal_force();
  const double held = sliding_share(contact, way);
  stiffness.topLeftCorner<2, 2>() += held * contact.tangential_stiffness * t * t.transpose();
  const double turning = rolling_share(contact, way);
  stiffness(2, 2) = turning * contact.rolling_stiffness;
  if (normal_force > 0.0) {
    const Eigen::RowVector2d of_opening = contact.normal_stiffness / normal_force * n.transpose();
    stiffness.topLeftCorner<2, 2>() -= (1.0 - held) * contact.tangential_force() * t * of_opening;
    stiffness.row(2).head<2>() = -(1.0 - turning) * contact.moment.z() * of_opening;
  }

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
