// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>

#include "common/cell_response.hpp"
#include "dem/cell/increment_slip.hpp"
#include "dem/cell/network_solver.hpp"
#include "dem/cell/relaxed_network.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// The law of one contact of spheres linearised where it stands (docs/theory/grains.md, C.9): from the opening (three
/// components of the displacement of the second surface against the first, and the rotation vector of the second grain
/// against the first) to the change of force and moment on the first grain.
///
/// Of a spring that has given way over the increment the rest along and across its way acts
/// (spring_left_along, spring_left_across), and it changes with the normal force by the rest of its share in it: a contact
/// that slides to the end of the increment keeps |f_t| = mu f_n, one at its rolling limit |M| = (limit / f_n) f_n. The
/// torsion spring acts where the law has one (li_chu), and the rolling stiffness of models that do not tell it counts as
/// zero.
struct LinearSpaceContact {
  Eigen::Matrix<double, 6, 6> stiffness;  ///< N/m, N; N, N m/rad
  Eigen::Matrix<double, 6, 12> motions;   ///< opening from (u, rotation) of the first, then the second grain
  Eigen::Matrix<double, 6, 18>
      affine;  ///< opening from a Cosserat strain; transposed: V stress from the force

  /// @param frame turns vectors of the contact into the frame of the strain
  LinearSpaceContact(const Contact& contact, const Eigen::Matrix3d& frame, const SpaceSlip& slip = {});
};

/// A cell of spheres as its tangents see it; see ContactNetwork.
struct SpaceNetwork {
  std::span<const Contact> contacts;
  int grains = 0;         ///< contacts refer to 0 .. grains - 1
  Eigen::Matrix3d frame;  ///< turns vectors of the contacts into the frame of the tangent
  double volume = 0.0;    ///< m^3
  double hold = 0.0;      ///< spring on each grain, over the mean normal stiffness
  /// Of the contacts over the increment that the tangent is the derivative by; empty: by a further one, infinitely small.
  std::span<const SpaceSlip> slips = {};
};

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

  RelaxedNetwork<LinearSpaceContact, SpaceNetworkSolver, kSpaceMotions, 18> network_;
  RelaxedNetwork<LinearSpaceContact, QuickSpaceNetworkSolver, kSpaceMotions, 18> quick_;
  EliminationDigits digits_;
  int repeated_ = 0;
};

}  // namespace polargrain::dem
