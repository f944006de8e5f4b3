// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>

namespace polargrain::dem {

/// How far the springs of a contact go, one way or the other, along an increment of a given strain: it decides how near
/// to its limit a spring must stand to be spent on the way (docs/theory/grains.md, C.7).
struct WayOfSprings {
  double slip = 0.0;  ///< m
  double turn = 0.0;  ///< rad

  /// Measured on cells, as are the two factors (docs/theory/grains.md, C.7): half of the affine slip, and the strain.
  /// @param strain size of the increment @param branch length, m
  static WayOfSprings of(double strain, double branch) { return {0.5 * strain * branch, strain}; }
};

/// The share of a spring that still answers along an increment: 1 far from its limit, 0 at it, and in between in
/// proportion to the distance from the limit over the way that the spring goes. Contacts do not slide steadily: they
/// come to their limit, let go, fall back and come again, so that those near it at one moment are those that slide.
/// @param value force or moment, its size @param way m or rad; 0: the share is 1 but at the limit itself
inline double spring_share(double value, double limit, double stiffness, double way) {
  /// Nothing that stands farther than this share of the limit below it counts as spent, however long the way: a network
  /// with more springs spent than that has motions without stiffness.
  constexpr double kFarthest = 0.3;
  const double missing = std::max(0.0, limit - value);
  const double reach = std::min(stiffness * way, kFarthest * limit);
  return missing < reach ? missing / reach : 1.0;
}

}  // namespace polargrain::dem
