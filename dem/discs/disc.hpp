// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Kernels of several instruction sets include this file: no code of the standard library (dem/lanes/vectors.hpp).
#include <cstdint>

namespace polargrain::dem {

/// One grain of a plane box as the loop over contacts wants it: everything a contact reads in one cache line.
/// Positions count from the corner of the box, in its frame; they are not folded back while the box moves.
struct alignas(64) Disc {
  double x = 0.0, y = 0.0;       ///< centre, m
  double vx = 0.0, vy = 0.0;     ///< m/s
  double spin = 0.0;             ///< about e_3, counted from the frame of the box, rad/s
  double radius = 0.0;           ///< m
  double inverse_mass = 0.0;     ///< 1/kg
  double inverse_inertia = 0.0;  ///< 1/(kg m^2)
};

/// Resultant of the contacts of one disc.
struct alignas(32) DiscForce {
  double x = 0.0, y = 0.0;  ///< N
  double torque = 0.0;      ///< N m
  double unused = 0.0;      ///< keeps four numbers in step with a vector register
};

/// The force of the last pass on a disc, damping included, and how far it has turned.
struct alignas(32) DiscMotion {
  double ax = 0.0, ay = 0.0;  ///< m/s^2
  double angular = 0.0;       ///< rad/s^2
  double turned = 0.0;        ///< rotation in the laboratory since the packing, rad
};

/// A lattice vector of the box as it is now: where an image lies and how fast it moves.
struct alignas(32) MovingImage {
  double x = 0.0, y = 0.0;    ///< m
  double vx = 0.0, vy = 0.0;  ///< m/s
};

/// A lattice vector p b_1 + q b_2 of the periodic box.
struct LatticeVector {
  std::int32_t p = 0;
  std::int32_t q = 0;
  bool operator==(const LatticeVector&) const = default;
};

}  // namespace polargrain::dem
