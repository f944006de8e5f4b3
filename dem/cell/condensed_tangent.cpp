// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/condensed_tangent.hpp"

#include <Eigen/Sparse>
#include <Eigen/UmfPackSupport>
#include <array>
#include <cmath>
#include <vector>

#include "dem/cell/averages.hpp"

namespace polargrain::dem {

namespace {

using Matrix26 = Eigen::Matrix<double, 2, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// The linearised law of one contact: d(force on first) = stiffness * (relative displacement of the
/// surfaces), and how that displacement follows from the motions (u, v, spin) of both grains and from the
/// strain e11, e22, e12 + e21.
struct Linearised {
  Eigen::Vector2d branch;
  Eigen::Matrix2d stiffness;  // 2x2, from the opening to the force on first
  Matrix26 motions;           // opening from (u, v, spin) of first, then of second
  std::array<double, 2> arms{};
  Eigen::Vector2d tangent;
};

Linearised linearise(const Contact& contact, const Eigen::Matrix2d& frame) {
  Linearised law;
  law.branch = frame * contact.branch;
  const Eigen::Vector2d n = law.branch.normalized();
  const Eigen::Vector2d t(-n.y(), n.x());
  law.tangent = t;
  law.arms = {contact.arm_first, contact.arm_second};
  const Eigen::Matrix2d normal = n * n.transpose();
  if (contact.sliding()) {
    const double ratio = std::copysign(contact.friction, contact.tangential_force());
    law.stiffness = contact.normal_stiffness * (normal - ratio * t * n.transpose());
  } else {
    law.stiffness = contact.normal_stiffness * normal + contact.tangential_stiffness * t * t.transpose();
  }
  // (v_B - v_A) . t - r_A w_A - r_B w_B (D.1); spins move the surfaces along t only.
  law.motions << -Eigen::Matrix2d::Identity(), -contact.arm_first * t, Eigen::Matrix2d::Identity(),
      -contact.arm_second * t;
  return law;
}

/// Generalised forces on both grains (force, force, moment each) from the force on the first.
Vector6 loads(const Linearised& law, const Eigen::Vector2d& force) {
  const double along = force.dot(law.tangent);
  Vector6 on_grains;
  on_grains << force, law.arms[0] * along, -force, law.arms[1] * along;
  return on_grains;
}

/// Volume times the stress rates under unit strains e, which open a contact of branch l by e^T l (first index
/// of a strain = branch), once the grains have found their equilibrium. With weights, the weighted mean of
/// the rotations is held at zero by one more unknown, the multiplier.
std::optional<std::vector<Eigen::Matrix2d>> relaxed_rates(std::span<const Contact> contacts, int grains,
                                                          std::span<const double> weights,
                                                          const Eigen::Matrix2d& frame, double hold,
                                                          std::span<const Eigen::Matrix2d> strains) {
  const int unknowns = 3 * grains + (weights.empty() ? 0 : 1);
  const auto columns = static_cast<Eigen::Index>(strains.size());
  std::vector<Linearised> laws;
  std::vector<std::array<int, 2>> places;
  std::vector<Eigen::Triplet<double>> entries;
  laws.reserve(contacts.size());
  places.reserve(contacts.size());
  entries.reserve(36 * contacts.size() + 5 * static_cast<std::size_t>(grains));
  Eigen::MatrixXd affine = Eigen::MatrixXd::Zero(unknowns, columns);
  for (const Contact& contact : contacts) {
    const Linearised law = linearise(contact, frame);
    const std::array<int, 2> place{3 * contact.first, 3 * contact.second};
    const auto at = [&place](int k) { return place[k / 3] + k % 3; };
    for (int column = 0; column < 6; ++column) {
      const Vector6 load = loads(law, law.stiffness * law.motions.col(column));
      for (int row = 0; row < 6; ++row) entries.emplace_back(at(row), at(column), load(row));
    }
    for (Eigen::Index k = 0; k < columns; ++k) {
      const Vector6 load = loads(law, law.stiffness * (strains[k].transpose() * law.branch));
      for (int row = 0; row < 6; ++row) affine(at(row), k) -= load(row);
    }
    laws.push_back(law);
    places.push_back(place);
  }
  // The stiffness as assembled pulls grains back with a minus sign (a grain moved apart is pulled back): hold
  // alike.
  const double spring = hold * mean_normal_stiffness(contacts);
  const double arm = contacts.front().arm_first;
  for (int k = 0; k < grains; ++k) {
    entries.emplace_back(3 * k, 3 * k, -spring);
    entries.emplace_back(3 * k + 1, 3 * k + 1, -spring);
    entries.emplace_back(3 * k + 2, 3 * k + 2, -spring * arm * arm);
    if (weights.empty()) continue;
    entries.emplace_back(3 * k + 2, 3 * grains, weights[k]);
    entries.emplace_back(3 * grains, 3 * k + 2, weights[k]);
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::UmfPackLU<Eigen::SparseMatrix<double>> factors(matrix);
  if (factors.info() != Eigen::Success) return std::nullopt;
  const Eigen::MatrixXd fluctuation = factors.solve(affine);
  if (factors.info() != Eigen::Success || !fluctuation.allFinite()) return std::nullopt;

  std::vector<Eigen::Matrix2d> rates(strains.size(), Eigen::Matrix2d::Zero());
  for (std::size_t c = 0; c < laws.size(); ++c) {
    const Linearised& law = laws[c];
    Vector6 motion;
    for (Eigen::Index k = 0; k < columns; ++k) {
      motion << fluctuation.col(k).segment<3>(places[c][0]), fluctuation.col(k).segment<3>(places[c][1]);
      const Eigen::Vector2d force =
          law.stiffness * (law.motions * motion + strains[k].transpose() * law.branch);
      rates[k] += law.branch * force.transpose();
    }
  }
  return rates;
}

Eigen::Matrix2d unit(int row, int column, double value = 1.0) {
  Eigen::Matrix2d strain = Eigen::Matrix2d::Zero();
  strain(row, column) = value;
  return strain;
}

}  // namespace

std::optional<Matrix7> condensed_tangent(std::span<const Contact> contacts, int grains,
                                         const Eigen::Matrix2d& frame, double volume, double hold) {
  if (contacts.empty()) return Matrix7::Zero();
  const std::array<Eigen::Matrix2d, 3> strains{unit(0, 0), unit(1, 1), unit(0, 1, 0.5) + unit(1, 0, 0.5)};
  const auto rates = relaxed_rates(contacts, grains, {}, frame, hold, strains);
  if (!rates) return std::nullopt;
  return symmetrised_tangent({(*rates)[0], (*rates)[1], (*rates)[2]}, volume);
}

std::optional<Matrix7> condensed_cosserat_tangent(std::span<const Contact> contacts,
                                                  std::span<const double> weights,
                                                  const Eigen::Matrix2d& frame, double volume, double hold) {
  Matrix7 tangent = Matrix7::Zero();
  if (contacts.empty()) return tangent;
  const std::array<Eigen::Matrix2d, 4> strains{unit(0, 0), unit(1, 1), unit(0, 1), unit(1, 0)};
  const auto rates = relaxed_rates(contacts, static_cast<int>(weights.size()), weights, frame, hold, strains);
  if (!rates) return std::nullopt;
  constexpr std::array<Component, 4> columns{k11, k22, k12, k21};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const Eigen::Matrix2d rate = (*rates)[k] / volume;
    tangent(k11, columns[k]) = rate(0, 0);
    tangent(k22, columns[k]) = rate(1, 1);
    tangent(k12, columns[k]) = rate(0, 1);
    tangent(k21, columns[k]) = rate(1, 0);
  }
  return tangent;
}

}  // namespace polargrain::dem
