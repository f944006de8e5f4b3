// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <optional>
#include <span>
#include <vector>

#include "dem/cell/averages.hpp"
#include "dem/cell/network_solver.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// One contact in a network by the whole matrices of its law. Spheres have products of its parts (SpaceContactParts).
///
/// @tparam Law `stiffness`, `motions` and `affine` as in LinearContact, rotations last
template <class Law, int Rotations>
class WholeContact {
 public:
  static constexpr int kMotions = Law::kMotions;
  template <int Strains>
  using Sides = Eigen::Matrix<double, 2 * kMotions, Strains>;
  template <int Strains>
  using Forces = Eigen::Matrix<double, kMotions, Strains>;

  /// @param arm m: rotations of grains count as arc lengths of it
  WholeContact(const Law& law, double arm) : law_(law), arm_(arm) {
    law_.motions.template middleCols<Rotations>(kMotions - Rotations) /= arm;
    law_.motions.template middleCols<Rotations>(2 * kMotions - Rotations) /= arm;
  }

  /// Its share in the equations of the grains' motions, with what the strains leave out of balance.
  template <int Strains, class Strain, class Equations>
  void share(const Strain& strains, Equations& added) const {
    const Eigen::Matrix<double, 2 * kMotions, kMotions> forces = law_.motions.transpose() * law_.stiffness;
    added.stiffness.noalias() = forces * law_.motions;
    added.right_sides.template leftCols<Strains>().noalias() = -forces * (law_.affine * strains);
  }
  /// @param motion of both grains @param stresses their sum over the contacts, times the volume: added to @param on_grains forces
  /// @param affine_forces without the motion, N
  template <int Strains, class Strain>
  void relax(const Sides<Strains>& motion, const Strain& strains, Strain& stresses, Sides<Strains>& on_grains,
             Forces<Strains>& affine_forces) const {
    const Forces<Strains> affine = law_.affine * strains;
    const Forces<Strains> forces = law_.stiffness * (law_.motions * motion + affine);
    stresses.noalias() += law_.affine.transpose() * forces;
    on_grains = law_.motions.transpose() * forces;
    affine_forces = law_.stiffness * affine;
    affine_forces.template bottomRows<Rotations>() /= arm_;
  }

 private:
  Law law_;
  double arm_;
};

/// A network of contacts to first order whose grains find their own equilibrium under strains: the common part of condensed
/// tangents of discs and of spheres (docs/theory/grains.md, C.7 (ii)). An object keeps memory between calls, never a
/// result.
///
/// @tparam Law of one contact: WholeContact or SpaceContactParts
/// @tparam Components of a strain, and of a stress
template <class Law, class Solver, int Motions, int Components>
class RelaxedNetwork {
 public:
  template <int Strains>
  using Columns = Eigen::Matrix<double, Components, Strains>;  // a strain, or a stress, a column

  /// @param set for tests; results do not depend on it
  explicit RelaxedNetwork(InstructionSet set) : solver_(set) {}

  /// Stresses once the grains have found their equilibrium under given strains, or nothing where the forces found do not
  /// balance.
  /// @param network contacts, grains, volume, hold as in ContactNetwork; there is a contact at least
  /// @param weights one a grain: the weighted means of the rotations are held at zero; empty: they are free
  /// @param law_of law_of(c, arm) returns the Law of contacts[c], rotations as arc lengths of an arm
  template <int Strains, class Network, class LawOf>
  std::optional<Columns<Strains>> stresses(const Network& network, std::span<const double> weights,
                                           const Columns<Strains>& strains, const LawOf& law_of);

 private:
  static constexpr int kStride = Solver::kStride;
  static constexpr int kAxes = Solver::kRotations;
  static constexpr int kFirstAxis = Solver::kFirstRotation;

  /// Rows of a grain in memory: displacements, and rotations as arc lengths.
  template <int Strains>
  using GrainRows = Eigen::Matrix<double, Motions, Strains, Eigen::RowMajor>;
  template <int Strains>
  using Multipliers = Eigen::Matrix<double, kAxes, Strains>;

  template <int Strains>
  auto fluctuation(int grain) const {
    return Eigen::Map<const GrainRows<Strains>, 0, Eigen::OuterStride<kStride>>(solver_.solution(grain));
  }
  template <int Strains>
  bool find_fluctuations(std::span<const Contact> contacts, int grains, std::span<const double> weights,
                         const Columns<Strains>& strains, double spring);
  template <int Strains>
  Multipliers<Strains> hold_mean_rotation(std::span<const double> weights);

  Solver solver_;
  std::vector<Law> laws_;
  std::vector<double> unbalanced_;  // N: forces that the fluctuations leave, by grain, component and strain
};

template <class Law, class Solver, int Motions, int Components>
template <int Strains, class Network, class LawOf>
auto RelaxedNetwork<Law, Solver, Motions, Components>::stresses(const Network& network,
                                                                std::span<const double> weights,
                                                                const Columns<Strains>& strains,
                                                                const LawOf& law_of)
    -> std::optional<Columns<Strains>> {
  const std::span<const Contact> contacts = network.contacts;
  // Rotations count as arc lengths of the first contact's arm, so that all entries are stiffnesses in N/m and
  // pivots can be compared.
  const double arm = contacts.front().arm_first;
  laws_.clear();
  for (std::size_t c = 0; c < contacts.size(); ++c) laws_.push_back(law_of(c, arm));
  const double spring = network.hold * mean_normal_stiffness(contacts);
  if (!find_fluctuations<Strains>(contacts, network.grains, weights, strains, spring)) return std::nullopt;
  const bool held = !weights.empty();
  Multipliers<Strains> multipliers = Multipliers<Strains>::Zero();
  if (held) multipliers = hold_mean_rotation<Strains>(weights);

  constexpr std::size_t kOfGrain = static_cast<std::size_t>(Motions) * Strains;
  unbalanced_.assign(kOfGrain * static_cast<std::size_t>(network.grains), 0.0);
  const auto unbalanced = [this](int grain) {
    return Eigen::Map<GrainRows<Strains>>(unbalanced_.data() + kOfGrain * static_cast<std::size_t>(grain));
  };
  using Forces = Eigen::Matrix<double, Motions, Strains>;
  Columns<Strains> stresses = Columns<Strains>::Zero();
  Forces largest = Forces::Zero();
  Forces affine_forces;
  Eigen::Matrix<double, 2 * Motions, Strains> on_grains;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Law& law = laws_[c];
    Eigen::Matrix<double, 2 * Motions, Strains> motion;
    motion << fluctuation<Strains>(contacts[c].first), fluctuation<Strains>(contacts[c].second);
    law.template relax<Strains>(motion, strains, stresses, on_grains, affine_forces);
    unbalanced(contacts[c].first) += on_grains.template topRows<Motions>();
    unbalanced(contacts[c].second) += on_grains.template bottomRows<Motions>();
    largest = largest.cwiseMax(affine_forces.cwiseAbs());
  }
  const Eigen::RowVector<double, Strains> allowed = Solver::kLargestUnbalance * largest.colwise().maxCoeff();
  for (int grain = 0; grain < network.grains; ++grain) {
    GrainRows<Strains> left = unbalanced(grain) + spring * fluctuation<Strains>(grain);
    if (held) left.template bottomRows<kAxes>() += weights[static_cast<std::size_t>(grain)] * multipliers;
    if (!(left.cwiseAbs().colwise().maxCoeff().array() <= allowed.array()).all()) return std::nullopt;
  }
  return Columns<Strains>(stresses / network.volume);
}

/// Motions of the grains on top of the affine field, for each strain; with weights, also those that a torque
/// on each grain by its weight makes, about each axis.
template <class Law, class Solver, int Motions, int Components>
template <int Strains>
bool RelaxedNetwork<Law, Solver, Motions, Components>::find_fluctuations(std::span<const Contact> contacts,
                                                                         int grains,
                                                                         std::span<const double> weights,
                                                                         const Columns<Strains>& strains,
                                                                         double spring) {
  const auto equations = [this, &strains](int c) {
    typename Solver::Equations added;
    laws_[static_cast<std::size_t>(c)].template share<Strains>(strains, added);
    added.right_sides.template middleCols<kAxes>(Strains).setZero();
    return added;
  };
  return solver_.solve(contacts, grains, Strains + (weights.empty() ? 0 : kAxes), spring, weights, equations);
}

/// One more unknown an axis, the multiplier, and one more equation, by bordering: from the fluctuations found without
/// them, so many of the motions made by the torques are taken off that no mean rotation is left.
/// @returns the multipliers
template <class Law, class Solver, int Motions, int Components>
template <int Strains>
auto RelaxedNetwork<Law, Solver, Motions, Components>::hold_mean_rotation(std::span<const double> weights)
    -> Multipliers<Strains> {
  using Rows = Eigen::Matrix<double, Motions, Eigen::Dynamic, Eigen::RowMajor>;
  Multipliers<Strains> mean = Multipliers<Strains>::Zero();
  Eigen::Matrix<double, kAxes, kAxes> of_torques = Eigen::Matrix<double, kAxes, kAxes>::Zero();
  const int grains = static_cast<int>(weights.size());
  const auto rows = [this](int grain) {
    return Eigen::Map<Rows, 0, Eigen::OuterStride<kStride>>(solver_.solution(grain), Motions,
                                                            Strains + kAxes);
  };
  for (int grain = 0; grain < grains; ++grain) {
    const auto motion = rows(grain);
    const double weight = weights[static_cast<std::size_t>(grain)];
    mean += weight * motion.bottomLeftCorner(kAxes, Strains);
    of_torques += weight * motion.bottomRightCorner(kAxes, kAxes);
  }
  Multipliers<Strains> multipliers;
  if constexpr (kAxes == 1)
    multipliers = mean / of_torques(0, 0);
  else
    multipliers = of_torques.inverse() * mean;
  for (int grain = 0; grain < grains; ++grain) {
    auto motion = rows(grain);
    motion.leftCols(Strains) -= motion.rightCols(kAxes).eval() * multipliers;
  }
  return multipliers;
}

}  // namespace polargrain::dem
