// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "coupler/cells/cell_calls.hpp"
#include "fem/material/stress_subspaces.hpp"

namespace polargrain::coupler {

/// How much of each kind of stress a packing can carry, found by taking it to its limit three times from rest: sheared
/// at constant volume, with its grains turned against the box, and bent (docs/theory/plasticity.md, B.9). All are the
/// largest value met on the way.
struct CellLimits {
  double friction = 0.0;  ///< M of the cone that collapses in plane strain where the packing does (B.3)
  double skew = 0.0;      ///< |s21 - s12| / p; 2 mu for discs of one friction
  double couple = 0.0;    ///< |m| / p, m; (4/pi) mu_th r_c for discs with rolling resistance
  std::string not_sheared = {};  ///< why friction was not found; empty: it was
  std::string not_turned = {};   ///< why the limit of skew stress was not found; empty: it was

  /// The weights with which a cone of that friction also yields at these limits of skew stress and couple stress
  /// (C.6): p_2 = 4 M^2 / (3 skew^2), p_3 = 2 M^2 lc^2 / (3 couple^2).
  /// @param internal_length lc that the elastic couple modulus 2 G lc^2 has, m
  [[nodiscard]] fem::InvariantWeights weights(double internal_length) const;
  /// The length of the plastic couple stresses, m: lc / sqrt(2 a3) of those weights.
  [[nodiscard]] double plastic_length() const;
  [[nodiscard]] std::string text() const;
};

/// The weight p_3 = 2 a3 with which a cone yields at a couple stress of `limit` times the pressure (docs/theory/plasticity.md, B.9).
/// @param friction M of the cone @param internal_length lc, m @param limit m
[[nodiscard]] double couple_weight(double friction, double internal_length, double limit);

/// Friction and the limit of skew stress alone, of grains whose rotations are controlled or turned: there is no bending, and
/// `couple` is 0. Never throws for what the grains do: a path ends where it cannot be followed. A path without one answer at
/// rest has its reason in not_sheared or not_turned. A limit that was found may be 0.
/// @param to_shear cells to shear @param at_rest their packing
/// @param to_turn cells to turn @param at_rest_to_turn their packing
CellLimits limits_without_bending(const CellCalls<2>& to_shear, const PlaneReply& at_rest,
                                  const CellCalls<2>& to_turn, const PlaneReply& at_rest_to_turn);

/// @param packing at rest, whose rotations are controlled @param mean_diameter of its grains, m
/// @throws RunError where a path cannot be followed or a limit cannot be found
CellLimits limits_of(const CellCalls<2>& calls, const PlaneReply& packing, double mean_diameter);

}  // namespace polargrain::coupler
