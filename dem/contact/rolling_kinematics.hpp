// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The kinematics that the tangential and the rolling law of Li and Chu share: relative rotation, the reduced radius, and
// springs that turn with the contact. Vectors follow the engine: en points from grain j to grain i,
// everything is seen as acting on i. With n = -en and t = e_3 x n the measures of docs/theory.md, D.1 are
//   sliding s = -u_s t,   relative rotation W = w_i - w_j = -theta_r e_3,   rolling displacement R* en x W =
//   -u_r t.
#include <contact_models.h>

#include <array>
#include <cmath>

#include "dem/contact/closing_factor.hpp"
#include "dem/contact/points_up.hpp"
#include "dem/contact/standing_at_limit.hpp"

namespace polargrain::dem {

using Vector = std::array<double, 3>;

inline double dot(const double* a, const double* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double length(const double* a) {
  return std::sqrt(dot(a, a));
}
inline Vector cross(const double* a, const double* b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// R* = r_i r_j / (r_i + r_j); a wall is a grain of infinite radius.
inline double reduced_radius(const LIGGGHTS::ContactModels::SurfacesIntersectData& contact) {
  return contact.is_wall ? contact.radi : contact.radi * contact.radj / (contact.radi + contact.radj);
}

/// +1 where i is the grain A of docs/theory/grains.md, D, -1 where it is B: A is the one with the lower id. The
/// rolling friction force changes its sign when A and B are exchanged (D.3), so both grains of a contact across
/// a periodic face, which compute it separately, must agree on who is who.
inline double side(const LIGGGHTS::ContactModels::SurfacesIntersectData& contact, const int* tag) {
  if (contact.is_wall || tag[contact.i] < tag[contact.j]) return 1.0;
  if (tag[contact.i] > tag[contact.j]) return -1.0;
  return points_up(contact.delta) ? 1.0 : -1.0;
}

/// Rate of the rotation of i relative to j, rad/s, the curvature of the cell included (RecordedModel). Walls do
/// not spin.
inline Vector relative_spin(const LIGGGHTS::ContactModels::SurfacesIntersectData& contact) {
  const double* const wi = contact.omega_i;
  if (contact.is_wall) return {wi[0], wi[1], wi[2]};
  const double* const wj = contact.omega_j;
  return {wi[0] - wj[0], wi[1] - wj[1], wi[2] - wj[2]};
}

/// Angle by which the pair has turned as a whole about its normal in a step, rad.
inline double twirl(const LIGGGHTS::ContactModels::SurfacesIntersectData& contact, double time_step) {
  double spin = dot(contact.omega_i, contact.en);
  if (!contact.is_wall) spin += dot(contact.omega_j, contact.en);
  return 0.5 * spin * time_step;
}

/// Turns a stored vector of the contact plane with the contact: about the normal by the twirl, and into the
/// new plane, keeping its length. Projection alone loses length to second order in the angle of a step, which
/// adds up.
inline void turn_with_contact(double* spring, const double* normal, double twirl_angle) {
  const double old_square = dot(spring, spring);
  if (old_square == 0.0) return;
  if (twirl_angle != 0.0) {
    const Vector turn = cross(normal, spring);
    for (int axis = 0; axis < 3; ++axis) spring[axis] += twirl_angle * turn[axis];
  }
  const double out_of_plane = dot(spring, normal);
  for (int axis = 0; axis < 3; ++axis) spring[axis] -= out_of_plane * normal[axis];
  const double square = dot(spring, spring);
  if (square == 0.0) return;
  const double stretch = std::sqrt(old_square / square);
  for (int axis = 0; axis < 3; ++axis) spring[axis] *= stretch;
}

/// Moves the bending part of the relative rotation of a contact (a vector of the contact plane, rad) over a
/// step.
inline void advance_bending(double* bending, const LIGGGHTS::ContactModels::SurfacesIntersectData& contact,
                            const Vector& spin, double time_step) {
  turn_with_contact(bending, contact.en, twirl(contact, time_step));
  const double torsion_rate = dot(spin.data(), contact.en);
  for (int axis = 0; axis < 3; ++axis)
    bending[axis] += (spin[axis] - torsion_rate * contact.en[axis]) * time_step;
}

/// Scales a vector down to a length. @return whether it was longer.
inline bool limit_length(double* vector, double limit) {
  const double square = dot(vector, vector);
  if (square <= limit * limit) return false;
  const double factor = limit / std::sqrt(square);
  for (int axis = 0; axis < 3; ++axis) vector[axis] *= factor;
  return true;
}

/// Whether the force of a spring stands at its limit; one without a limit, which is zero, does.
inline bool stands_at(double force, double limit) {
  return std::abs(force) >= kStandingAtLimit * limit;
}
inline bool stands_at(const double* force, double limit) {
  const double least = kStandingAtLimit * limit;
  return dot(force, force) >= least * least;
}

}  // namespace polargrain::dem
