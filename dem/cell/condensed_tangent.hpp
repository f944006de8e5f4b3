// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>

#include "common/increment.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// Tangent d stress / d strain of a cell whose grains find their own equilibrium (C.7 (ii)), for free mean
/// rotation (mode 1): the stiffness of the contact network on the fluctuations of positions and spins is
/// factorised once, and the affine forces of the three unit strains are relaxed with it. Sliding contacts
/// keep f_t = +-mu f_n, so the matrix is not symmetric. Symmetrised in shear, as the stress of mode 1 is.
///
/// A network with sliding contacts and rattlers has motions without stiffness; every grain is held by a
/// spring of `hold` times the mean normal stiffness, which leaves those motions as they are and changes the
/// rest little.
///
/// @param grains number of grains; contacts refer to 0 .. grains - 1
/// @param frame turns vectors of the contacts into the frame of the tangent
/// @returns nothing when the factorisation fails
std::optional<Matrix7> condensed_tangent(std::span<const Contact> contacts, int grains,
                                         const Eigen::Matrix2d& frame, double volume, double hold);

/// The same with the mean rotation prescribed (mode 2): not symmetrised, shears eps12 and eps21 apart. Grains
/// turn relative to the mean rotation, with sum of weights times relative rotation equal to zero.
/// @param weights one a grain, adding up to 1 (FixCellStrain)
std::optional<Matrix7> condensed_cosserat_tangent(std::span<const Contact> contacts,
                                                  std::span<const double> weights,
                                                  const Eigen::Matrix2d& frame, double volume, double hold);

}  // namespace polargrain::dem
