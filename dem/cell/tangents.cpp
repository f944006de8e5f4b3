// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/tangents.hpp"

#include <Eigen/Sparse>
#include <Eigen/UmfPackSupport>
#include <array>
#include <vector>

#include "dem/cell/averages.hpp"
#include "dem/cell/linear_contact.hpp"

namespace polargrain::dem {

namespace {

using Strains = Eigen::Matrix<double, 7, Eigen::Dynamic>;  // a strain, or a stress, a column

/// The symmetric unit strains e11, e22 and e12 + e21.
Strains classical_strains() {
  Strains strains = Strains::Zero(7, 3);
  strains(k11, 0) = strains(k22, 1) = 1.0;
  strains(k12, 2) = strains(k21, 2) = 0.5;
  return strains;
}

Matrix7 classical_tangent(const Strains& stresses) {
  Matrix7 tangent = Matrix7::Zero();
  tangent.col(k11) = stresses.col(0);
  tangent.col(k22) = stresses.col(1);
  tangent.col(k12) = tangent.col(k21) = stresses.col(2);
  const Eigen::RowVectorXd shear = 0.5 * (tangent.row(k12) + tangent.row(k21));
  tangent.row(k12) = tangent.row(k21) = shear;
  tangent.bottomRows<2>().setZero();
  return tangent;
}

/// Stresses once the grains have found their equilibrium under given strains. With weights, the weighted mean
/// of the rotations is held at zero by one more unknown, the multiplier.
std::optional<Strains> relaxed_stresses(std::span<const Contact> contacts, int grains,
                                        std::span<const double> weights, const Eigen::Matrix2d& frame,
                                        double volume, double hold, const Strains& strains) {
  const int unknowns = 3 * grains + (weights.empty() ? 0 : 1);
  std::vector<LinearContact> laws;
  std::vector<Eigen::Triplet<double>> entries;
  laws.reserve(contacts.size());
  entries.reserve(36 * contacts.size() + 5 * static_cast<std::size_t>(grains));
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(unknowns, strains.cols());
  for (const Contact& contact : contacts) {
    const LinearContact& law = laws.emplace_back(contact, frame);
    const Eigen::Matrix<double, 6, 3> forces = law.motions.transpose() * law.stiffness;
    const Eigen::Matrix<double, 6, 6> stiffness = forces * law.motions;
    const std::array<int, 2> place{3 * contact.first, 3 * contact.second};
    for (int column = 0; column < 6; ++column)
      for (int row = 0; row < 6; ++row)
        entries.emplace_back(place[row / 3] + row % 3, place[column / 3] + column % 3,
                             stiffness(row, column));
    const Eigen::Matrix<double, 6, Eigen::Dynamic> load = forces * (law.affine * strains);
    for (int side = 0; side < 2; ++side) loads.middleRows<3>(place[side]) -= load.middleRows<3>(3 * side);
  }
  const double spring = hold * mean_normal_stiffness(contacts);
  const double arm = contacts.front().arm_first;
  for (int k = 0; k < grains; ++k) {
    entries.emplace_back(3 * k, 3 * k, spring);
    entries.emplace_back(3 * k + 1, 3 * k + 1, spring);
    entries.emplace_back(3 * k + 2, 3 * k + 2, spring * arm * arm);
    if (weights.empty()) continue;
    entries.emplace_back(3 * k + 2, 3 * grains, weights[k]);
    entries.emplace_back(3 * grains, 3 * k + 2, weights[k]);
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::UmfPackLU<Eigen::SparseMatrix<double>> factors(matrix);
  if (factors.info() != Eigen::Success) return std::nullopt;
  const Eigen::MatrixXd fluctuations = factors.solve(loads);
  if (factors.info() != Eigen::Success || !fluctuations.allFinite()) return std::nullopt;

  Strains stresses = Strains::Zero(7, strains.cols());
  Eigen::Matrix<double, 6, Eigen::Dynamic> motion(6, strains.cols());
  for (std::size_t c = 0; c < laws.size(); ++c) {
    motion << fluctuations.middleRows<3>(3 * contacts[c].first),
        fluctuations.middleRows<3>(3 * contacts[c].second);
    const LinearContact& law = laws[c];
    stresses += law.affine.transpose() * (law.stiffness * (law.motions * motion + law.affine * strains));
  }
  return Strains(stresses / volume);
}

}  // namespace

Matrix7 voigt_cosserat_tangent(std::span<const Contact> contacts, const Eigen::Matrix2d& frame,
                               double volume) {
  Matrix7 sum = Matrix7::Zero();
  for (const Contact& contact : contacts) {
    const LinearContact law(contact, frame);
    sum += law.affine.transpose() * law.stiffness * law.affine;
  }
  return sum / volume;
}

Matrix7 voigt_tangent(std::span<const Contact> contacts, const Eigen::Matrix2d& frame, double volume) {
  return classical_tangent(voigt_cosserat_tangent(contacts, frame, volume) * classical_strains());
}

std::optional<Matrix7> condensed_tangent(std::span<const Contact> contacts, int grains,
                                         const Eigen::Matrix2d& frame, double volume, double hold) {
  if (contacts.empty()) return Matrix7::Zero();
  const auto stresses = relaxed_stresses(contacts, grains, {}, frame, volume, hold, classical_strains());
  if (!stresses) return std::nullopt;
  return classical_tangent(*stresses);
}

std::optional<Matrix7> condensed_cosserat_tangent(std::span<const Contact> contacts,
                                                  std::span<const double> weights,
                                                  const Eigen::Matrix2d& frame, double volume, double hold) {
  if (contacts.empty()) return Matrix7::Zero();
  const auto stresses = relaxed_stresses(contacts, static_cast<int>(weights.size()), weights, frame, volume,
                                         hold, Matrix7::Identity());
  if (!stresses) return std::nullopt;
  return Matrix7(*stresses);
}

}  // namespace polargrain::dem
