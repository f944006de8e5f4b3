// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>

#include "common/cell_response.hpp"
#include "dem/cell/linear_space_contact.hpp"
#include "dem/cell/network_solver.hpp"
#include "dem/cell/relaxed_network.hpp"
#include "dem/cell/space_network.hpp"

namespace polargrain::dem {

// Tangents d stress / d strain of a cell of spheres; rows and columns as in CellResponse::tangent. The classical ones are
// those of free rotations: the stress symmetrised in shear, a shear strain acting through its symmetric part, no couple
// stresses. The Cosserat ones have the grains turn with the micro-rotation, on average.

/// Affine (C.7 (i)).
Matrix18 voigt_space_tangent(const SpaceNetwork& network);
Matrix18 voigt_cosserat_space_tangent(const SpaceNetwork& network);

/// The digits that the elimination of a condensed tangent of spheres carries.
enum class EliminationDigits {
  single_where_balanced,  ///< single precision, and double where the forces found do not balance to 1e-3
  whole                   ///< double precision
};

/// The condensed tangents (C.7 (ii)) with six motions a grain; see CondensedTangent. An object keeps memory between calls,
/// never a result.
class CondensedSpaceTangent {
 public:
  explicit CondensedSpaceTangent(InstructionSet set = best_instruction_set(),
                                 EliminationDigits digits = EliminationDigits::single_where_balanced)
      : network_(set), quick_(set), digits_(digits) {}

  /// Rotations free. Empty when the network has no solution that balances its forces.
  std::optional<Matrix18> classical(const SpaceNetwork& network);
  /// The weighted means of the rotations about the three axes prescribed. @param weights one a grain, adding up to 1, or
  /// empty: then the mean is free too
  std::optional<Matrix18> cosserat(const SpaceNetwork& network, std::span<const double> weights);

  /// How many of this object's tangents double precision had to be taken for.
  [[nodiscard]] int repeated() const { return repeated_; }

 private:
  template <int Strains>
  std::optional<Eigen::Matrix<double, 18, Strains>> stresses(
      const SpaceNetwork& network, std::span<const double> weights,
      const Eigen::Matrix<double, 18, Strains>& strains);

  RelaxedNetwork<SpaceContactParts, SpaceNetworkSolver, kSpaceMotions, 18> network_;
  RelaxedNetwork<SpaceContactParts, QuickSpaceNetworkSolver, kSpaceMotions, 18> quick_;
  EliminationDigits digits_;
  int repeated_ = 0;
};

}  // namespace polargrain::dem
