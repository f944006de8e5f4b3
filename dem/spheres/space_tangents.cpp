// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/spheres/space_tangents.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "dem/cell/averages.hpp"
#include "dem/spheres/space_contact.hpp"

namespace polargrain::dem {

namespace {

/// The largest force that may stay unbalanced on a grain, over the largest affine force of a contact.
constexpr double kLargestUnbalance = 1e-9;

constexpr int kStride = SpaceNetworkSolver::kStride;
constexpr int kMotions = kSpaceMotions;
constexpr int kAxes = 3;

/// x -> n x x
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& n) {
  Eigen::Matrix3d made;
  made << 0.0, -n.z(), n.y(), n.z(), 0.0, -n.x(), -n.y(), n.x(), 0.0;
  return made;
}

/// A spring in some directions that may have given way.
struct SlippedSpring {
  double stiffness = 0.0;
  Eigen::Vector3d value;  // what it carries
  double limit = 0.0;     // of |value|; 0 when there is none
  double slip = 0.0;
  bool at_limit = false;
};

/// To first order: what it answers to a motion in its directions, and over the normal stiffness to an opening along n.
struct LinearSpring {
  Eigen::Matrix3d of_motion;
  Eigen::Matrix3d of_opening;
};
/// @param directions projects on those of the spring
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

using ClassicalStrains = Eigen::Matrix<double, 18, 6>;

/// Where e_ij stands.
constexpr int place(int i, int j) {
  return 3 * i + j;
}
/// The symmetric unit strains e11, e22, e33, e12 + e21, e13 + e31, e23 + e32.
constexpr int kFirst[] = {0, 1, 2, 0, 0, 1};
constexpr int kSecond[] = {0, 1, 2, 1, 2, 2};

ClassicalStrains classical_strains() {
  ClassicalStrains strains = ClassicalStrains::Zero();
  for (int k = 0; k < 6; ++k) {
    strains(place(kFirst[k], kSecond[k]), k) += 0.5;
    strains(place(kSecond[k], kFirst[k]), k) += 0.5;
  }
  return strains;
}

Matrix18 classical_tangent(const ClassicalStrains& stresses) {
  Matrix18 tangent = Matrix18::Zero();
  for (int k = 0; k < 6; ++k)
    tangent.col(place(kFirst[k], kSecond[k])) = tangent.col(place(kSecond[k], kFirst[k])) = stresses.col(k);
  for (int k = 3; k < 6; ++k) {
    const int one = place(kFirst[k], kSecond[k]);
    const int other = place(kSecond[k], kFirst[k]);
    const Eigen::RowVector<double, 18> shear = 0.5 * (tangent.row(one) + tangent.row(other));
    tangent.row(one) = tangent.row(other) = shear;
  }
  tangent.bottomRows<9>().setZero();
  return tangent;
}

template <int Strains>
auto fluctuation(const SpaceNetworkSolver& solver, int grain) {
  using Rows = Eigen::Matrix<double, kMotions, Strains, Eigen::RowMajor>;
  return Eigen::Map<const Rows, 0, Eigen::OuterStride<kStride>>(solver.solution(grain));
}

/// One more unknown an axis, the multiplier, and one more equation, by bordering: from the fluctuations found without,
/// so many of the motions made by the torques are taken off that no mean rotation is left. @returns the multipliers
template <int Strains>
Eigen::Matrix<double, kAxes, Strains> hold_mean_rotation(SpaceNetworkSolver& solver,
                                                         std::span<const double> weights) {
  using Corrections = Eigen::Matrix<double, kAxes, Strains>;
  Corrections mean = Corrections::Zero();
  Eigen::Matrix3d of_torques = Eigen::Matrix3d::Zero();
  const int grains = static_cast<int>(weights.size());
  using Rows = Eigen::Matrix<double, kMotions, Eigen::Dynamic, Eigen::RowMajor>;
  const auto rows = [&solver](int grain) {
    return Eigen::Map<Rows, 0, Eigen::OuterStride<kStride>>(solver.solution(grain), kMotions,
                                                            Strains + kAxes);
  };
  for (int grain = 0; grain < grains; ++grain) {
    const auto motion = rows(grain);
    mean += weights[grain] * motion.bottomLeftCorner(kAxes, Strains);
    of_torques += weights[grain] * motion.bottomRightCorner(kAxes, kAxes);
  }
  const Corrections multipliers = of_torques.inverse() * mean;
  for (int grain = 0; grain < grains; ++grain) {
    auto motion = rows(grain);
    motion.leftCols(Strains) -= motion.rightCols(kAxes).eval() * multipliers;
  }
  return multipliers;
}

}  // namespace

LinearSpaceContact::LinearSpaceContact(const Contact& contact, const Eigen::Matrix3d& frame,
                                       const SpaceSlip& slip) {
  const Eigen::Vector3d branch = frame * branch_of(contact);
  const Eigen::Vector3d n = branch.normalized();
  const Eigen::Matrix3d along = n * n.transpose();
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along;
  const double normal_force = space_normal_force(contact);
  const Eigen::Vector3d moment = frame * moment_of(contact);

  SlippedSpring sliding;
  sliding.stiffness = contact.tangential_stiffness;
  sliding.value = across * (frame * force_of(contact));
  sliding.limit = contact.friction * std::max(0.0, normal_force);
  sliding.slip = slip.sliding;
  sliding.at_limit = slides_in_space(contact);
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
  return classical_tangent(voigt_cosserat_space_tangent(network) * classical_strains());
}

std::optional<Matrix18> CondensedSpaceTangent::classical(const SpaceNetwork& network) {
  if (network.contacts.empty()) return Matrix18::Zero();
  const auto stresses = relaxed_stresses<6>(network, {}, classical_strains());
  if (!stresses) return std::nullopt;
  return classical_tangent(*stresses);
}

std::optional<Matrix18> CondensedSpaceTangent::cosserat(const SpaceNetwork& network,
                                                        std::span<const double> weights) {
  if (network.contacts.empty()) return Matrix18::Zero();
  const Columns<18> strains = Columns<18>::Identity();
  return relaxed_stresses<18>(network, weights, strains);
}

template <int Strains>
std::optional<CondensedSpaceTangent::Columns<Strains>> CondensedSpaceTangent::relaxed_stresses(
    const SpaceNetwork& network, std::span<const double> weights, const Columns<Strains>& strains) {
  const std::span<const Contact> contacts = network.contacts;
  // Rotations count as arc lengths of the first contact's arm, so that all entries are stiffnesses in N/m and
  // pivots can be compared.
  const double arm = contacts.front().arm_first;
  laws_.clear();
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    LinearSpaceContact& law = laws_.emplace_back(contacts[c], network.frame,
                                                 network.slips.empty() ? SpaceSlip{} : network.slips[c]);
    law.motions.middleCols<3>(3) /= arm;
    law.motions.middleCols<3>(9) /= arm;
  }
  const double spring = network.hold * mean_normal_stiffness(contacts);
  const auto equations = [this, &strains](int c) {
    const LinearSpaceContact& law = laws_[static_cast<std::size_t>(c)];
    const Eigen::Matrix<double, 12, 6> forces = law.motions.transpose() * law.stiffness;
    SpaceNetworkSolver::Equations added;
    added.stiffness.noalias() = forces * law.motions;
    added.right_sides.template leftCols<Strains>().noalias() = -forces * (law.affine * strains);
    added.right_sides.template middleCols<kAxes>(Strains).setZero();
    return added;
  };
  const bool held = !weights.empty();
  if (!solver_.solve(contacts, network.grains, Strains + (held ? kAxes : 0), spring, weights, equations))
    return std::nullopt;
  Eigen::Matrix<double, kAxes, Strains> multipliers = Eigen::Matrix<double, kAxes, Strains>::Zero();
  if (held) multipliers = hold_mean_rotation<Strains>(solver_, weights);

  using Rows = Eigen::Matrix<double, kMotions, Strains, Eigen::RowMajor>;
  constexpr std::size_t kOfGrain = static_cast<std::size_t>(kMotions) * Strains;
  unbalanced_.assign(kOfGrain * static_cast<std::size_t>(network.grains), 0.0);
  const auto unbalanced = [this](int grain) {
    return Eigen::Map<Rows>(unbalanced_.data() + kOfGrain * static_cast<std::size_t>(grain));
  };
  using Forces = Eigen::Matrix<double, 6, Strains>;
  Columns<Strains> stresses = Columns<Strains>::Zero();
  Forces largest = Forces::Zero();
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const LinearSpaceContact& law = laws_[c];
    Eigen::Matrix<double, 12, Strains> motion;
    motion << fluctuation<Strains>(solver_, contacts[c].first),
        fluctuation<Strains>(solver_, contacts[c].second);
    const Forces affine = law.affine * strains;
    const Forces forces = law.stiffness * (law.motions * motion + affine);
    stresses.noalias() += law.affine.transpose() * forces;
    const Eigen::Matrix<double, 12, Strains> on_grains = law.motions.transpose() * forces;
    unbalanced(contacts[c].first) += on_grains.template topRows<6>();
    unbalanced(contacts[c].second) += on_grains.template bottomRows<6>();
    Forces affine_forces = law.stiffness * affine;
    affine_forces.template bottomRows<3>() /= arm;
    largest = largest.cwiseMax(affine_forces.cwiseAbs());
  }
  const Eigen::RowVector<double, Strains> allowed = kLargestUnbalance * largest.colwise().maxCoeff();
  for (int grain = 0; grain < network.grains; ++grain) {
    Rows left = unbalanced(grain) + spring * fluctuation<Strains>(solver_, grain);
    if (held) left.template bottomRows<3>() += weights[static_cast<std::size_t>(grain)] * multipliers;
    if (!(left.cwiseAbs().colwise().maxCoeff().array() <= allowed.array()).all()) return std::nullopt;
  }
  return Columns<Strains>(stresses / network.volume);
}

}  // namespace polargrain::dem
