// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/linear_space_contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace polargrain::dem {

namespace {

/// A spring in some directions that may have given way.
struct SlippedSpring {
  double stiffness = 0.0;
  Eigen::Vector3d value;  // the force it carries
  double limit = 0.0;     // of |value|; 0: no limit
  double slip = 0.0;
  bool at_limit = false;
};

/// To first order: its answer to a motion in its directions, and over the normal stiffness to an opening along n.
struct LinearSpring {
  Eigen::Matrix3d of_motion;
  Eigen::Matrix3d of_opening;
};
/// @param directions projects on the directions of the spring
LinearSpring linear(const SlippedSpring& spring, const Eigen::Matrix3d& directions, double normal_force,
                    const Eigen::Vector3d& n) {
  LinearSpring made{spring.stiffness * directions, Eigen::Matrix3d::Zero()};
  const double size = spring.value.norm();
  if (!(size > 0.0) || !(normal_force > 0.0) || !(spring.limit > 0.0)) {
    if (spring.at_limit) made.of_motion.setZero();
    return made;
  }
  const double unloaded = std::max(0.0, spring.limit - size) / spring.stiffness;
  const double along = spring.at_limit ? 0.0 : spring_left_along(spring.slip, unloaded);
  if (along == 1.0) return made;
  // Unloading leaves its direction alone: across, no less is left than along.
  const double across = std::max(along, spring_left_across(spring.slip, size / spring.stiffness));
  const Eigen::Vector3d way = spring.value / size;
  made.of_motion = spring.stiffness * (across * directions + (along - across) * way * way.transpose());
  made.of_opening = -(1.0 - along) / normal_force * spring.value * n.transpose();
  return made;
}

}  // namespace

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& n) {
  Eigen::Matrix3d made;
  made << 0.0, -n.z(), n.y(), n.z(), 0.0, -n.x(), -n.y(), n.x(), 0.0;
  return made;
}

SpaceContactStiffness::SpaceContactStiffness(const Contact& contact, const Eigen::Matrix3d& frame,
                                             const SpaceSlip& slip)
    : branch(frame * contact.branch), normal(branch.normalized()) {
  const Eigen::Vector3d& n = normal;
  const Eigen::Matrix3d along = n * n.transpose();
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along;
  const double normal_force = contact.normal_force();
  const Eigen::Vector3d moment = frame * contact.moment;

  SlippedSpring sliding;
  sliding.stiffness = contact.tangential_stiffness;
  sliding.value = across * (frame * contact.force);
  sliding.limit = contact.friction * std::max(0.0, normal_force);
  sliding.slip = slip.sliding;
  sliding.at_limit = contact.sliding();
  const auto of_moment = [&](double stiffness, const Eigen::Matrix3d& directions, double slipped,
                             bool at_limit) {
    const Eigen::Vector3d value = directions * moment;
    return SlippedSpring{stiffness, value, at_limit ? value.norm() : contact.rolling_limit, slipped,
                         at_limit};
  };
  const SlippedSpring bending =
      of_moment(contact.rolling_stiffness, across, slip.bending, contact.rolling_at_limit);
  const SlippedSpring torsion =
      of_moment(contact.torsion_stiffness, along, slip.torsion, contact.torsion_at_limit);

  const LinearSpring slides = linear(sliding, across, normal_force, n);
  force_of_opening = contact.normal_stiffness * (along + slides.of_opening) + slides.of_motion;
  const LinearSpring bends = linear(bending, across, normal_force, n);
  const LinearSpring twists = linear(torsion, along, normal_force, n);
  moment_of_turning = bends.of_motion + twists.of_motion;
  moment_of_opening = contact.normal_stiffness * (bends.of_opening + twists.of_opening);
}

LinearSpaceContact::LinearSpaceContact(const Contact& contact, const Eigen::Matrix3d& frame,
                                       const SpaceSlip& slip) {
  const SpaceContactStiffness law(contact, frame, slip);
  const Eigen::Vector3d& branch = law.branch;
  stiffness << law.force_of_opening, Eigen::Matrix3d::Zero(), law.moment_of_opening, law.moment_of_turning;

  // A rotation w moves the surface of the first by r_A w x n, that of the second by -r_B w x n.
  const Eigen::Matrix3d lever = cross_matrix(law.normal);
  motions.setZero();
  motions.block<3, 3>(0, 0) = -Eigen::Matrix3d::Identity();
  motions.block<3, 3>(0, 3) = contact.arm_first * lever;
  motions.block<3, 3>(0, 6) = Eigen::Matrix3d::Identity();
  motions.block<3, 3>(0, 9) = contact.arm_second * lever;
  motions.block<3, 3>(3, 3) = -Eigen::Matrix3d::Identity();
  motions.block<3, 3>(3, 9) = Eigen::Matrix3d::Identity();

  // opening_j = l_i eps_ij, rotation_j = l_i kappa_ij (C.6), and the slip of unequal radii (C.8).
  affine.setZero();
  const Eigen::Matrix3d polar = 0.5 * (contact.arm_second - contact.arm_first) * lever;
  for (int i = 0; i < 3; ++i) {
    affine.block<3, 3>(0, 3 * i) = branch(i) * Eigen::Matrix3d::Identity();
    affine.block<3, 3>(3, 9 + 3 * i) = branch(i) * Eigen::Matrix3d::Identity();
    affine.block<3, 3>(0, 9 + 3 * i) = branch(i) * polar;
  }
}

}  // namespace polargrain::dem
