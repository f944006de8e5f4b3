// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <vector>

#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// Mass and inertia of grains.
struct Inertia {
  std::vector<double> masses;   ///< kg
  std::vector<double> moments;  ///< of inertia, kg m^2
  std::vector<double> radii;    ///< m
  bool space = false;           ///< spheres that move and turn in space; else discs in their plane
};

/// Share of the largest stable step that the program takes by itself. The network of contacts stiffens
/// between two looks at it: a step of that share stays stable until the stiffest mode is 1.56 times as stiff.
inline constexpr double kStepShare = 0.8;

/// The largest eigenfrequency, rad/s, of grains on the springs of their contacts (normal, tangential,
/// rolling; rotations included; at contacts that slide or roll at their limit too): the root of the largest
/// eigenvalue of M^-1 K, by Lanczos iteration, to 0.1 % from below. 0 without contacts.
double largest_frequency(std::span<const Contact> contacts, const Inertia& inertia);

/// An upper bound of the same in one pass over the contacts: as (a + b)^2 <= 2 (a^2 + b^2), K is at most
/// twice its diagonal blocks, and so is the eigenvalue at most twice the largest of one grain among grains
/// that stand still. At most 1.42 times too large.
double frequency_bound(std::span<const Contact> contacts, const Inertia& inertia);

/// The largest stable step of the central differences that integrate the grains, s; infinite without springs:
///   dt = 2 / omega (sqrt(1 + zeta^2) - zeta),
/// where zeta is the share of critical damping of the mode with the frequency omega: forces of dashpots come
/// from the velocity half a step before (Belytschko, Liu and Moran 2000, section 6.2). It is taken from the
/// dashpots of the contacts, as if all of them were like the one with the longest time viscosity / stiffness,
/// and from the damping against the affine flow.
/// @param frequency rad/s @param viscous_time longest of the contacts, s @param damping_rate of the affine
/// damping, 1/s
double stable_time_step(double frequency, double viscous_time, double damping_rate);

/// Longest time viscosity / stiffness of the dashpots of the contacts, s.
double longest_viscous_time(std::span<const Contact> contacts);

/// The stiffest contacts of a packing in the making.
struct StiffestContact {
  double normal_stiffness = 0.0;      ///< N/m
  double tangential_stiffness = 0.0;  ///< N/m
  double rolling_stiffness = 0.0;     ///< N m
  double viscous_time = 0.0;          ///< s

  void see(std::span<const Contact> contacts);
  /// A frequency that no mode exceeds, on the whole, whatever comes to touch next: the frequency of the lightest grain
  /// among `neighbours` of the stiffest contacts on all sides, doubled as in frequency_bound, rad/s.
  [[nodiscard]] double crowded_frequency(const Inertia& inertia, double neighbours) const;
};

/// A step that is kStepShare of the stable one, with three digits: it is the same for networks that differ by
/// rounding.
double chosen_time_step(double stable);

}  // namespace polargrain::dem
