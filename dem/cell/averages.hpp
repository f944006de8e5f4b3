// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <span>

#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

// Averages over the contacts of a cell, in the frame of the box. Between discs only the components of their plane differ
// from zero: of couple stresses the last column (m1, m2).

/// Average stress of a cell (docs/theory/grains.md, C.2): sigma_ij = (1/V) sum over contacts of l_i f_j, with
/// l the branch from the first grain to the second and f the force on the first; tension positive, first
/// index the face normal, Pa. Not symmetric while moments are unbalanced or couples act on the grains.
Eigen::Matrix3d average_stress(std::span<const Contact> contacts, double volume);

/// Average couple stress (C.8): m_ij = (1/V) sum of l_i [ M + (r_second - r_first) / 2 f_t x n ]_j, with M the rolling
/// resistance moment on the first grain, f_t the tangential force on it, and r the arms to the contact; N/m. i is the
/// normal of the face, j the axis of the moment; the reference point is the middle of each branch.
Eigen::Matrix3d average_couple_stress(std::span<const Contact> contacts, double volume);

/// Fabric tensor F_ij = mean of n_i n_j over the contacts: symmetric, trace 1; zero without contacts.
Eigen::Matrix3d fabric_tensor(std::span<const Contact> contacts);

/// Mean magnitude of the contact forces, N; 0 without contacts.
double mean_contact_force(std::span<const Contact> contacts);

/// Mean normal stiffness of the contacts, N/m; 0 without contacts.
double mean_normal_stiffness(std::span<const Contact> contacts);

}  // namespace polargrain::dem
