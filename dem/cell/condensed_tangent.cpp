// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/condensed_tangent.hpp"

#include "dem/cell/averages.hpp"
#include "dem/cell/plain_tangents.hpp"
#include "dem/cell/tangent_strains.hpp"

namespace polargrain::dem {

namespace {

/// The largest force that may stay unbalanced on a grain, over the largest affine force of a contact.
constexpr double kLargestUnbalance = 1e-9;

constexpr int kStride = PlaneNetworkSolver::kStride;

/// Rows of a grain in memory: displacements, and rotation as an arc length.
template <int Strains>
using GrainRows = Eigen::Matrix<double, 3, Strains, Eigen::RowMajor>;

template <int Strains>
auto fluctuation(const PlaneNetworkSolver& solver, int grain) {
  return Eigen::Map<const GrainRows<Strains>, 0, Eigen::OuterStride<kStride>>(solver.solution(grain));
}

}  // namespace

std::optional<Matrix7> CondensedTangent::classical(const ContactNetwork& network) {
  if (network.contacts.empty()) return Matrix7::Zero();
  const auto stresses = relaxed_stresses<3>(network, {}, classical_strains());
  if (stresses) return classical_tangent(*stresses);
  ++fallbacks_;
  return plain_classical_tangent(network);
}

std::optional<Matrix7> CondensedTangent::cosserat(const ContactNetwork& network,
                                                  std::span<const double> weights) {
  if (network.contacts.empty()) return Matrix7::Zero();
  const auto stresses = relaxed_stresses<6>(network, weights, cosserat_strains());
  if (stresses) return cosserat_tangent(*stresses);
  ++fallbacks_;
  return plain_cosserat_tangent(network, weights);
}

/// Stresses once the grains have found their equilibrium under given strains, or nothing where the solver did
/// not find it.
template <int Strains>
std::optional<CondensedTangent::Columns<Strains>> CondensedTangent::relaxed_stresses(
    const ContactNetwork& network, std::span<const double> weights, const Columns<Strains>& strains) {
  const std::span<const Contact> contacts = network.contacts;
  // Rotations count as arc lengths of the first contact's arm, so that all entries are stiffnesses in N/m and
  // pivots can be compared.
  const double arm = contacts.front().arm_first;
  laws_.clear();
  for (const Contact& contact : contacts) {
    LinearContact& law = laws_.emplace_back(contact, network.frame, network.strain);
    law.motions.col(2) /= arm;
    law.motions.col(5) /= arm;
  }
  const double spring = network.hold * mean_normal_stiffness(contacts);
  if (!find_fluctuations<Strains>(network, weights, strains, spring)) return std::nullopt;
  Eigen::RowVector<double, Strains> multipliers = Eigen::RowVector<double, Strains>::Zero();
  if (!weights.empty()) multipliers = hold_mean_rotation<Strains>(weights);

  unbalanced_.assign(3 * static_cast<std::size_t>(network.grains) * Strains, 0.0);
  const auto unbalanced = [this](int grain) {
    return Eigen::Map<GrainRows<Strains>>(unbalanced_.data() + 3 * static_cast<std::size_t>(grain) * Strains);
  };
  using Forces = Eigen::Matrix<double, 3, Strains>;
  Columns<Strains> stresses = Columns<Strains>::Zero();
  Forces largest = Forces::Zero();
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const LinearContact& law = laws_[c];
    Eigen::Matrix<double, 6, Strains> motion;
    motion << fluctuation<Strains>(solver_, contacts[c].first),
        fluctuation<Strains>(solver_, contacts[c].second);
    const Forces affine = law.affine * strains;
    const Forces forces = law.stiffness * (law.motions * motion + affine);
    stresses.noalias() += law.affine.transpose() * forces;
    const Eigen::Matrix<double, 6, Strains> on_grains = law.motions.transpose() * forces;
    unbalanced(contacts[c].first) += on_grains.template topRows<3>();
    unbalanced(contacts[c].second) += on_grains.template bottomRows<3>();
    Forces affine_forces = law.stiffness * affine;
    affine_forces.row(2) /= arm;
    largest = largest.cwiseMax(affine_forces.cwiseAbs());
  }
  const Eigen::RowVector<double, Strains> allowed = kLargestUnbalance * largest.colwise().maxCoeff();
  for (int grain = 0; grain < network.grains; ++grain) {
    GrainRows<Strains> left = unbalanced(grain) + spring * fluctuation<Strains>(solver_, grain);
    if (!weights.empty()) left.row(2) += weights[grain] * multipliers;
    if (!(left.cwiseAbs().colwise().maxCoeff().array() <= allowed.array()).all()) return std::nullopt;
  }
  return Columns<Strains>(stresses / network.volume);
}

/// Motions of the grains on top of the affine field, for each strain; with weights, also those that a torque
/// on each grain by its weight makes.
template <int Strains>
bool CondensedTangent::find_fluctuations(const ContactNetwork& network, std::span<const double> weights,
                                         const Columns<Strains>& strains, double spring) {
  const auto equations = [this, &strains](int c) {
    const LinearContact& law = laws_[c];
    const Eigen::Matrix<double, 6, 3> forces = law.motions.transpose() * law.stiffness;
    PlaneNetworkSolver::Equations added;
    added.stiffness.noalias() = forces * law.motions;
    added.right_sides.template leftCols<Strains>().noalias() = -forces * (law.affine * strains);
    added.right_sides.col(Strains).setZero();
    return added;
  };
  const int right_sides = Strains + (weights.empty() ? 0 : 1);
  return solver_.solve(network.contacts, network.grains, right_sides, spring, weights, equations);
}

/// One more unknown, the multiplier, and one more equation, by bordering: from the fluctuations found without
/// it, that many of the motions made by the torques are taken off that no mean rotation is left.
/// @returns the multipliers
template <int Strains>
Eigen::RowVector<double, Strains> CondensedTangent::hold_mean_rotation(std::span<const double> weights) {
  using Row = Eigen::RowVector<double, Strains>;
  Row mean = Row::Zero();
  double of_torques = 0.0;
  const int grains = static_cast<int>(weights.size());
  for (int grain = 0; grain < grains; ++grain) {
    const double* rotations = solver_.solution(grain) + 2 * kStride;
    mean += weights[grain] * Eigen::Map<const Row>(rotations);
    of_torques += weights[grain] * rotations[Strains];
  }
  const Row multipliers = mean / of_torques;
  for (int grain = 0; grain < grains; ++grain)
    for (int k = 0; k < 3; ++k) {
      double* motion = solver_.solution(grain) + k * kStride;
      Eigen::Map<Row> corrected(motion);
      corrected -= motion[Strains] * multipliers;
    }
  return multipliers;
}

}  // namespace polargrain::dem
