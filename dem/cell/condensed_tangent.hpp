// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>

#include "common/increment.hpp"
#include "dem/cell/linear_contact.hpp"
#include "dem/cell/network_solver.hpp"
#include "dem/cell/relaxed_network.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// A cell as its condensed tangents see it.
struct ContactNetwork {
  std::span<const Contact> contacts;
  int grains = 0;         ///< contacts refer to 0 .. grains - 1
  Eigen::Matrix2d frame;  ///< turns vectors of the contacts into the frame of the tangent
  double volume = 0.0;    ///< m^3
  /// A network with sliding contacts and rattlers has motions without stiffness: every grain is held by a
  /// spring of `hold` times the mean normal stiffness, which leaves those motions as they are and changes the
  /// rest little.
  double hold = 0.0;
  double strain = 0.0;  ///< size of the increment that the tangent is for; 0: of the next infinitesimal one
};

/// The condensed tangents (C.7 (ii)) let the grains find their own equilibrium: the stiffness of the contact
/// network on the fluctuations of positions and rotations is factorised once, and the affine forces of the
/// unit strains are relaxed with it. Where the relaxed forces do not balance, the plain way is taken
/// (plain_tangents.hpp), which exchanges pivots freely. Empty when the network has no solution.
///
/// An object keeps memory between calls, never a result.
class CondensedTangent {
 public:
  /// @param set for tests; results do not depend on it
  explicit CondensedTangent(InstructionSet set = best_instruction_set()) : network_(set) {}

  /// Rotations free.
  std::optional<Matrix7> classical(const ContactNetwork& network);

  /// The weighted mean of the rotations prescribed.
  /// @param weights one a grain, adding up to 1 (FixCellStrain), or empty: then the mean is free too, as no
  /// grain can be turned
  std::optional<Matrix7> cosserat(const ContactNetwork& network, std::span<const double> weights);

  /// How many of this object's tangents were taken the plain way.
  [[nodiscard]] int fallbacks() const { return fallbacks_; }

 private:
  template <int Strains>
  std::optional<Eigen::Matrix<double, 7, Strains>> stresses(const ContactNetwork& network,
                                                            std::span<const double> weights,
                                                            const Eigen::Matrix<double, 7, Strains>& strains);

  RelaxedNetwork<WholeContact<LinearContact, 1>, PlaneNetworkSolver, kPlaneMotions, 7> network_;
  int fallbacks_ = 0;
};

}  // namespace polargrain::dem
