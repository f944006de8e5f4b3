// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <span>

#include "common/increment.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// Average stress of a cell (docs/theory/grains.md, C.2): sigma_ij = (1/V) sum over contacts of l_i f_j, with
/// l the branch from the first grain to the second and f the force on the first; tension positive, first
/// index the face normal, Pa. Not symmetric while moments are unbalanced.
Eigen::Matrix2d average_stress(std::span<const Contact> contacts, double volume);

/// Affine (Voigt) tangent d stress / d strain of a cell whose grains turn with the mean rotation (C.7 (i)),
/// symmetrised in shear. A sliding contact keeps f_t = +-mu f_n, which makes the tangent non-symmetric. Rows
/// and columns follow Component; those of s33 and of the couple stresses are zero.
/// @param frame turns vectors of the contacts into the frame of the tangent.
Matrix7 voigt_tangent(std::span<const Contact> contacts, const Eigen::Matrix2d& frame, double volume);

/// The tangent in the order of Component from volume-weighted stress rates under the unit strains e11, e22
/// and e12 + e21; shear stresses are symmetrised, and a shear strain acts through its symmetric part.
Matrix7 symmetrised_tangent(const std::array<Eigen::Matrix2d, 3>& stress_rates, double volume);

/// Mean magnitude of the contact forces, N; 0 without contacts.
double mean_contact_force(std::span<const Contact> contacts);

/// Mean normal stiffness of the contacts, N/m; 0 without contacts.
double mean_normal_stiffness(std::span<const Contact> contacts);

}  // namespace polargrain::dem
