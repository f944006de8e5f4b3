// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/space_tangents.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "dem/cell/tangent_strains.hpp"

namespace polargrain::dem {

namespace {

/// x -> n x x
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& n) {
  Eigen::Matrix3d made;
  made << 0.0, -n.z(), n.y(), n.z(), 0.0, -n.x(), -n.y(), n.x(), 0.0;
  return made;
}

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

LinearSpaceContact::LinearSpaceContact(const Contact& contact, const Eigen::Matrix3d& frame,
                                       const SpaceSlip& slip) {
  const Eigen::Vector3d branch = frame * contact.branch;
  const Eigen::Vector3d n = branch.normalized();
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
  SlippedSpring bending;
  bending.stiffness = contact.rolling_stiffness;
  bending.value = across * moment;
  bending.limit = contact.rolling_at_limit ? bending.value.norm() : contact.rolling_limit;
  bending.slip = slip.bending;
  bending.at_limit = contact.rolling_at_limit;
  SlippedSpring torsion;
  torsion.stiffness = contact.torsion_stiffness;
  torsion.value = along * moment;
  torsion.limit = contact.torsion_at_limit ? torsion.value.norm() : contact.rolling_limit;
  torsion.slip = slip.torsion;
  torsion.at_limit = contact.torsion_at_limit;

  stiffness.setZero();
  const LinearSpring slides = linear(sliding, across, normal_force, n);
  stiffness.topLeftCorner<3, 3>() = contact.normal_stiffness * (along + slides.of_opening) + slides.of_motion;
  const LinearSpring bends = linear(bending, across, normal_force, n);
  const LinearSpring twists = linear(torsion, along, normal_force, n);
  stiffness.bottomRightCorner<3, 3>() = bends.of_motion + twists.of_motion;
  stiffness.bottomLeftCorner<3, 3>() = contact.normal_stiffness * (bends.of_opening + twists.of_opening);

  // A rotation w moves the surface of the first by r_A w x n, that of the second by -r_B w x n.
  const Eigen::Matrix3d lever = cross_matrix(n);
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

Matrix18 voigt_cosserat_space_tangent(const SpaceNetwork& network) {
  Matrix18 sum = Matrix18::Zero();
  for (const Contact& contact : network.contacts) {
    const LinearSpaceContact law(contact, network.frame);
    sum.noalias() += law.affine.transpose() * (law.stiffness * law.affine);
  }
  return sum / network.volume;
}

Matrix18 voigt_space_tangent(const SpaceNetwork& network) {
  return classical_tangent<3>(voigt_cosserat_space_tangent(network) * classical_strains<3>());
}

template <int Strains>
std::optional<Eigen::Matrix<double, 18, Strains>> CondensedSpaceTangent::stresses(
    const SpaceNetwork& network, std::span<const double> weights,
    const Eigen::Matrix<double, 18, Strains>& strains) {
  const auto law_of = [&network](std::size_t c) {
    return LinearSpaceContact(network.contacts[c], network.frame,
                              network.slips.empty() ? SpaceSlip{} : network.slips[c]);
  };
  if (digits_ == EliminationDigits::single_where_balanced) {
    if (auto found = quick_.stresses<Strains>(network, weights, strains, law_of)) return found;
    ++repeated_;
  }
  return network_.stresses<Strains>(network, weights, strains, law_of);
}

std::optional<Matrix18> CondensedSpaceTangent::classical(const SpaceNetwork& network) {
  if (network.contacts.empty()) return Matrix18::Zero();
  const auto relaxed = stresses<6>(network, {}, classical_strains<3>());
  if (!relaxed) return std::nullopt;
  return classical_tangent<3>(*relaxed);
}

std::optional<Matrix18> CondensedSpaceTangent::cosserat(const SpaceNetwork& network,
                                                        std::span<const double> weights) {
  if (network.contacts.empty()) return Matrix18::Zero();
  return stresses<18>(network, weights, Matrix18::Identity());
}

}  // namespace polargrain::dem
