// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>

#include "common/increment.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

// Tangents d stress / d strain of a cell from its contacts (docs/theory/grains.md, C.7). Rows and columns
// follow Component; those of s33 are zero. `frame` turns vectors of the contacts into the frame of the
// tangent. The classical tangents are those of mode 1: symmetrised in shear, as the stress of free rotations
// is, a shear strain acting through its symmetric part, without couple stresses. The Cosserat ones are those
// of mode 2.
//
// The condensed tangents let the grains find their own equilibrium: the stiffness of the contact network on
// the fluctuations of positions and rotations is factorised once, and the affine forces of the unit strains
// are relaxed with it. A network with sliding contacts and rattlers has motions without stiffness; every
// grain is held by a spring of `hold` times the mean normal stiffness, which leaves those motions as they are
// and changes the rest little. They are empty when the factorisation fails.

/// Affine (C.7 (i)), grains that turn with the continuum.
Matrix7 voigt_tangent(std::span<const Contact> contacts, const Eigen::Matrix2d& frame, double volume);

/// Affine (C.7 (i)), grains that turn with the micro-rotation.
Matrix7 voigt_cosserat_tangent(std::span<const Contact> contacts, const Eigen::Matrix2d& frame,
                               double volume);

/// Condensed (C.7 (ii)), rotations free. @param grains contacts refer to 0 .. grains - 1
std::optional<Matrix7> condensed_tangent(std::span<const Contact> contacts, int grains,
                                         const Eigen::Matrix2d& frame, double volume, double hold);

/// Condensed (C.7 (ii)), the weighted mean of the rotations prescribed.
/// @param weights one a grain, adding up to 1 (FixCellStrain)
std::optional<Matrix7> condensed_cosserat_tangent(std::span<const Contact> contacts,
                                                  std::span<const double> weights,
                                                  const Eigen::Matrix2d& frame, double volume, double hold);

}  // namespace polargrain::dem
