// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <span>

#include "common/increment.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

// Tangents d stress / d strain of a cell from its contacts (docs/theory/grains.md, C.7). Rows and columns
// follow Component; s33 has zeros. `frame` turns vectors of the contacts into the frame of the
// tangent. The classical tangents are those of mode 1: symmetrised in shear, as the stress of free rotations
// is, a shear strain acting through its symmetric part, without couple stresses. The Cosserat ones are those
// of mode 2.

/// Affine (C.7 (i)), grains that turn with the continuum.
Matrix7 voigt_tangent(std::span<const Contact> contacts, const Eigen::Matrix2d& frame, double volume);

/// Affine (C.7 (i)), grains that turn with the micro-rotation.
Matrix7 voigt_cosserat_tangent(std::span<const Contact> contacts, const Eigen::Matrix2d& frame,
                               double volume);

}  // namespace polargrain::dem
