// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// A contact between discs for the laws (dem/laws/contact_law.hpp), as numbers along the normal n and the tangent t = e_3 x n.
// In the plane a spring of a contact has one component.
#include "dem/laws/contact_law.hpp"

namespace polargrain::dem {
namespace {

/// Two discs as they are about to meet.
template <typename Number>
struct DiscPair {
  Number dx, dy;                   ///< centre of the second to centre of the first, m
  Number vx, vy;                   ///< of the first against the second, m/s
  Number distance, over_distance;  ///< of the centres, m; one over it
  Number spin_first, spin_second;
  GrainPair<Number> grains;

  [[nodiscard]] POLARGRAIN_INLINE Number square() const { return dx * dx + dy * dy; }
  [[nodiscard]] POLARGRAIN_INLINE auto touches() const {
    const Number reach = grains.radius_first + grains.radius_second;
    return square() < reach * reach;
  }
  POLARGRAIN_INLINE void measure() {
    distance = root(square());
    over_distance = 1.0 / distance;
  }
};

/// Places of the springs (law_settings.hpp) in the order of the laws.
template <NormalLaw Normal, typename Kind, typename Number_>
struct DiscContact {
  using Number = Number_;
  using Tangent = Number;  ///< along t
  using Turn = Number;     ///< about e_3

  const ParametersOf<Number>& p;
  const LawSettings& settings;
  const GrainPair<Number>& grains;
  Number* springs;

  Number nx{}, ny{};                 ///< unit normal
  Number overlap{}, opening_rate{};  ///< m, m/s
  Number slip_rate{};         ///< of the first surface against the second along t, with the curvature, m/s
  Number spin{}, own_spin{};  ///< of the first against the second, with the curvature and without it, rad/s
  Number arm_first{}, arm_second{};  ///< centre to contact point, m

  /// Kinematics (D.1) of discs whose distance is measured. @param bend_x, bend_y rate of curvature in the frame of the
  /// box, rad/(m s)
  POLARGRAIN_INLINE DiscContact(const DiscPair<Number>& pair, const ParametersOf<Number>& parameters,
                                const LawSettings& on, double bend_x, double bend_y, Number* given)
      : p(parameters), settings(on), grains(pair.grains), springs(given) {
    nx = pair.dx * pair.over_distance;
    ny = pair.dy * pair.over_distance;
    overlap = grains.radius_first + grains.radius_second - pair.distance;
    arm_first = grains.radius_first - 0.5 * overlap;
    arm_second = grains.radius_second - 0.5 * overlap;
    opening_rate = pair.vx * nx + pair.vy * ny;
    // Spins seen from the middle of the branch (C.8).
    const Number bent = 0.5 * (bend_x * pair.dx + bend_y * pair.dy);
    const Number spin_first = pair.spin_first + bent;
    const Number spin_second = pair.spin_second - bent;
    slip_rate = pair.vy * nx - pair.vx * ny - (arm_first * spin_first + arm_second * spin_second);
    own_spin = pair.spin_first - pair.spin_second;
    spin = spin_first - spin_second;
  }

  POLARGRAIN_INLINE static Number flat(Number a) { return a; }
  POLARGRAIN_INLINE static Number turned(Number a) { return a; }
  POLARGRAIN_INLINE static Number across(Number turn) { return -turn; }
  POLARGRAIN_INLINE static Number lever(Number along) { return along; }
  /// The loop over discs drops the answers of those that have parted.
  POLARGRAIN_INLINE static Number where_touching(Number a) { return a; }

  POLARGRAIN_INLINE Number sliding() const {
    if constexpr (Kind::tangential == TangentialLaw::history) return springs[1] * nx - springs[0] * ny;
    return springs[0];
  }
  POLARGRAIN_INLINE void keep_sliding(Number a) const {
    if constexpr (Kind::tangential == TangentialLaw::history) {
      springs[0] = -a * ny;
      springs[1] = a * nx;
    } else {
      springs[0] = a;
    }
  }
  POLARGRAIN_INLINE Number rolled() const { return springs[1]; }
  POLARGRAIN_INLINE void keep_rolled(Number a) const { springs[1] = a; }
  POLARGRAIN_INLINE Number bending() const { return springs[kRollingSpring]; }
  POLARGRAIN_INLINE void keep_bending(Number a) const { springs[kRollingSpring] = a; }

  POLARGRAIN_INLINE void find_stiffnesses(bool damped, Stiffnesses<Number>& made) const {
    stiffnesses_of<Normal>(p, damped, settings.absolute_damping, grains, overlap, made);
  }
  POLARGRAIN_INLINE Number friction() const { return p.friction; }
  POLARGRAIN_INLINE Number rolling_stiffness(Number kt) const {
    return rolling_stiffness_of<Kind::rolling>(p, kt, rolling_radius<Kind::rolling>(settings, grains));
  }
  POLARGRAIN_INLINE Number rolling_reach() const {
    return p.rolling_friction * rolling_radius<Kind::rolling>(settings, grains);
  }
  POLARGRAIN_INLINE Number rolling_dashpot(Number stiffness) const {
    return rolling_dashpot_of(p, stiffness, grains);
  }
  POLARGRAIN_INLINE Number harmonic() const { return grains.harmonic; }
  POLARGRAIN_INLINE Number force_stiffness(Number kt) const { return p.rolling_force_stiffness * kt; }
  POLARGRAIN_INLINE Number force_friction() const { return p.rolling_force_friction; }
  POLARGRAIN_INLINE Number force_dashpot(Number stiffness) const {
    return force_dashpot_of(p, stiffness, grains);
  }
};

}  // namespace
}  // namespace polargrain::dem
