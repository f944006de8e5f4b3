// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/plain_tangents.hpp"

#include <Eigen/Sparse>
#include <array>
#include <vector>

#include "dem/cell/averages.hpp"
#include "dem/cell/linear_contact.hpp"
#include "dem/cell/tangent_strains.hpp"

namespace polargrain::dem {

namespace {

/// Stresses once the grains have found their equilibrium under given strains. With weights, the weighted mean
/// of the rotations is held at zero by one more unknown, the multiplier.
template <int Strains>
std::optional<Eigen::Matrix<double, 7, Strains>> relaxed_stresses(
    const ContactNetwork& network, std::span<const double> weights,
    const Eigen::Matrix<double, 7, Strains>& strains) {
  const std::span<const Contact> contacts = network.contacts;
  // Rotations count as arc lengths of the first contact's arm, so that all entries are stiffnesses in N/m.
  const double arm = contacts.front().arm_first;
  const Eigen::Vector<double, 6> units(1.0, 1.0, 1.0 / arm, 1.0, 1.0, 1.0 / arm);
  const int unknowns = 3 * network.grains + (weights.empty() ? 0 : 1);
  std::vector<LinearContact> laws;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(unknowns, Strains);
  for (const Contact& contact : contacts) {
    LinearContact& law = laws.emplace_back(contact, network.frame, network.strain);
    law.motions *= units.asDiagonal();
    const Eigen::Matrix<double, 6, 6> stiffness = law.motions.transpose() * law.stiffness * law.motions;
    const Eigen::Matrix<double, 6, Strains> load =
        law.motions.transpose() * law.stiffness * law.affine * strains;
    const std::array<int, 2> place{3 * contact.first, 3 * contact.second};
    for (int column = 0; column < 6; ++column)
      for (int row = 0; row < 6; ++row)
        entries.emplace_back(place[row / 3] + row % 3, place[column / 3] + column % 3,
                             stiffness(row, column));
    for (int side = 0; side < 2; ++side)
      loads.middleRows<3>(place[side]) -= load.template middleRows<3>(3 * side);
  }
  const double spring = network.hold * mean_normal_stiffness(contacts);
  for (int unknown = 0; unknown < 3 * network.grains; ++unknown)
    entries.emplace_back(unknown, unknown, spring);
  for (int grain = 0; grain < static_cast<int>(weights.size()); ++grain) {
    // The multiplier counts in units that make its entries as large as the others.
    const double weight = weights[grain] * network.grains * mean_normal_stiffness(contacts);
    entries.emplace_back(3 * grain + 2, 3 * network.grains, weight);
    entries.emplace_back(3 * network.grains, 3 * grain + 2, weight);
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(matrix);
  if (factors.info() != Eigen::Success) return std::nullopt;
  const Eigen::MatrixXd fluctuations = factors.solve(loads);
  const double residual = (matrix * fluctuations - loads).norm();
  if (!(residual <= 1e-9 * (matrix.norm() * fluctuations.norm() + loads.norm()))) return std::nullopt;

  Eigen::Matrix<double, 7, Strains> stresses = Eigen::Matrix<double, 7, Strains>::Zero();
  for (std::size_t c = 0; c < laws.size(); ++c) {
    Eigen::Matrix<double, 6, Strains> motion;
    motion << fluctuations.middleRows<3>(3 * contacts[c].first),
        fluctuations.middleRows<3>(3 * contacts[c].second);
    const LinearContact& law = laws[c];
    stresses += law.affine.transpose() * law.stiffness * (law.motions * motion + law.affine * strains);
  }
  return stresses / network.volume;
}

}  // namespace

std::optional<Matrix7> plain_classical_tangent(const ContactNetwork& network) {
  if (network.contacts.empty()) return Matrix7::Zero();
  const auto stresses = relaxed_stresses<3>(network, {}, classical_strains<2>());
  if (!stresses) return std::nullopt;
  return classical_tangent<2>(*stresses);
}

std::optional<Matrix7> plain_cosserat_tangent(const ContactNetwork& network,
                                              std::span<const double> weights) {
  if (network.contacts.empty()) return Matrix7::Zero();
  const auto stresses = relaxed_stresses<6>(network, weights, cosserat_strains());
  if (!stresses) return std::nullopt;
  return cosserat_tangent(*stresses);
}

}  // namespace polargrain::dem
