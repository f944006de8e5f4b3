// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <span>

#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

// The answer of a contact in space, and the averages over contacts of spheres (docs/theory/grains.md, C.9). Vectors are in
// the frame of the box, stresses too.

inline Eigen::Vector3d branch_of(const Contact& contact) {
  return {contact.branch.x(), contact.branch.y(), contact.branch_3};
}
/// On the first grain, N.
inline Eigen::Vector3d force_of(const Contact& contact) {
  return {contact.force.x(), contact.force.y(), contact.force_3};
}
/// The resistance moment on the first grain, N m.
inline Eigen::Vector3d moment_of(const Contact& contact) {
  return {contact.moment_12.x(), contact.moment_12.y(), contact.moment};
}

/// sigma_ij = (1/V) sum of l_i f_j: tension positive, first index the face normal, Pa.
Eigen::Matrix3d space_stress(std::span<const Contact> contacts, double volume);

/// m_ij = (1/V) sum of l_i [ M + (r_second - r_first) / 2 f_t x n ]_j, N/m: i the normal of the face, j the axis of the
/// moment; the reference point is the middle of each branch (C.8).
Eigen::Matrix3d space_couple_stress(std::span<const Contact> contacts, double volume);

/// F_ij = mean of n_i n_j over the contacts: symmetric, trace 1; zero without contacts.
Eigen::Matrix3d space_fabric(std::span<const Contact> contacts);

/// Compressive normal force, positive when the grains push each other, N.
double space_normal_force(const Contact& contact);

/// Whether the tangential spring stands at its Coulomb limit, as Contact::sliding does in the plane.
bool slides_in_space(const Contact& contact);

}  // namespace polargrain::dem
