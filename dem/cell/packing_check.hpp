// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "common/overlap_limit.hpp"
#include "common/packing.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

// Grains are rigid but for their contacts: laws of contacts mean something while overlaps are small against
// the grains. Beyond that an answer says nothing about grains, however well it is balanced.

/// As kMostMeanOverlap for the largest overlap: forces of contacts reach some five times their mean.
inline constexpr double kMostOverlap = 0.25;
/// An answer is unreliable beyond twice these. Grains that a run has pressed into each other more than a scene may have
/// at rest are shown and told (mean_overlap, largest_overlap), and do not end it: one contact of the many in a band would.
inline constexpr double kAllowanceOfAnswers = 2.0;
/// Void ratio beyond which discs are no packing: loose ones with friction have 0.3.
inline constexpr double kMostVoidRatio = 1.0;
/// The same of spheres: loose sand has 1.0, and rolling resistance holds looser ones.
inline constexpr double kMostVoidRatioInSpace = 1.5;
/// Relative difference between the pressure that a packing was recorded with and the one it has under its
/// script.
inline constexpr double kPressureTolerance = 0.01;
/// Unbalanced ratio, forces or moments, beyond which a packing is not at rest: ten times the usual one of
/// cells.
inline constexpr double kMostUnrest = 0.05;

/// Overlaps of the contacts over the smaller of their two radii.
struct Overlaps {
  double mean = 0.0;
  double largest = 0.0;
};
/// @param radii of the grains, m
Overlaps overlaps_of(std::span<const Contact> contacts, std::span<const double> radii);

/// Beyond kMostMeanOverlap or kMostOverlap, times the allowance.
bool too_large(const Overlaps& overlaps, double allowance = 1.0);
/// Both with their limits, for messages.
std::string description(const Overlaps& overlaps, double allowance = 1.0);

/// Overlap of two grains over the smaller radius beyond which no engine is asked: the centre of one is nearly
/// in the other, as no script can want it.
inline constexpr double kMostOverlapToStart = 0.75;
/// k_n / (p t) beyond which a packing carries no pressure to speak of: grains that touch and no more. Sand
/// under 1 kPa has 1e7.
inline constexpr double kMostStiffnessLevel = 1e10;

/// Why the places of the grains are not a packing, whatever the script: grains in one place, or no two that touch.
/// Empty when they are a packing. For before the first force: the engine itself does not survive all of these.
std::string geometry_fault(const Packing& packing);

/// Two grains that touch on two sides of a narrow box, in words: the tangential springs of a contact are kept by the names of its grains, so
/// that those of the two would be mixed up. Nothing when no grains do.
std::string twofold_contact(const Packing& packing);

/// A packing under a script before the first step.
struct PackingAtRest {
  double pressure = 0.0;         ///< mean normal stress, compression positive, Pa
  double recorded = 0.0;         ///< the packing file's, Pa; 0 when it has no pressure
  double stiffness_level = 0.0;  ///< mean k_n / (pressure * thickness)
  Equilibrium equilibrium;
  Overlaps overlaps;
  bool turns = true;   ///< some grain has two contacts or more: there is a mean rotation to control
  bool space = false;  ///< of spheres: the stiffness level is mean k_n / (pressure * mean diameter)
};

/// Why a packing does not fit its script, with the numbers and the remedy; empty when it does.
/// @param unrest the ratio that the user asks of cells; ten times that is allowed of the packing when it is
/// more than kMostUnrest @param script the user's file
std::string packing_fault(const PackingAtRest& packing, double unrest, const std::string& script);

/// Why the answer of a cell means nothing although it is at rest; nothing when it does.
/// @param most_void_ratio beyond which grains are no packing
std::string answer_fault(const Overlaps& overlaps, double void_ratio,
                         double most_void_ratio = kMostVoidRatio);

}  // namespace polargrain::dem
