// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <vector>

#include "common/cell.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

// How a cell is loaded and when it is at rest (docs/theory/grains.md, G.3): what the cells of a run and
// `fix cell/load` of a script must do alike, to the bit.

/// DEM steps between two looks at the equilibrium while a cell relaxes.
inline constexpr int kRelaxationChunk = 20;

/// DEM steps of the loading ramp of an increment, at the inertial number asked for.
/// @param time_of_grain mean diameter * sqrt(density / pressure), s @param mean_radius m @param time_step s
/// @throws RunError when that is more than 1e9
int loading_steps(const CellControl& control, const Increment& increment, double time_of_grain,
                  double mean_radius, double time_step);

/// Weights of the grains in the mean rotation (mode 2), W_p over the volume: the torque that the contacts of each
/// can carry, up to the coefficient of friction, over the sum of all. Zero with fewer than two contacts, or the
/// multiplier would spin up the grains that nothing holds. Empty when nothing carries any.
std::vector<double> rotation_weights(std::span<const Contact> contacts, int grains);

/// Resultants of the contacts of the grains, and of what holds their mean rotation, before damping.
struct Imbalance {
  double force = 0.0;   ///< sum over grains of its magnitude, N
  double moment = 0.0;  ///< the same, N m
  int grains = 0;
};

/// How far grains are from rest; see CellDiagnostics.
struct Unbalanced {
  double force_ratio = 0.0;   ///< 0 without contacts
  double moment_ratio = 0.0;  ///< 0 without contacts
  double carrying = 0.0;      ///< number of grains that touch others
};

/// Share of the mean contact force of the packing that unbalanced forces are compared with at least. Grains
/// that press on each other less than that carry nothing that counts: without it a cell whose stress has gone
/// to zero could never be at rest, as what grains that barely touch are out of balance is all the force there
/// is.
inline constexpr double kLeastForce = 1e-3;

/// Of the last force pass. @param mean_radius m
/// @param least_force the ratios are to the mean contact force, and to this when that is less, N
Unbalanced unbalanced(const Imbalance& imbalance, std::span<const Contact> contacts, double mean_radius,
                      double least_force);

/// How near a packing is to rest, and how its grains touch.
struct Equilibrium {
  /// Mean unbalanced force on the grains that touch others, over the mean contact force; 0 without contacts.
  double unbalanced_force_ratio = 0.0;
  /// The same for moments, over the mean contact force times the mean radius.
  double unbalanced_moment_ratio = 0.0;
  double void_ratio = 0.0;           ///< in plane
  double coordination_number = 0.0;  ///< 2 contacts / grains
  double rattlers = 0.0;             ///< grains without a contact / grains
};

/// @param least_force see unbalanced @param area of the box, m^2 @param grain_area sum, m^2
Equilibrium equilibrium_of(std::span<const Contact> contacts, const Imbalance& imbalance, double mean_radius,
                           double least_force, double area, double grain_area);

}  // namespace polargrain::dem
