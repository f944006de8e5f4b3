// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// A contact between spheres for the laws (dem/laws/contact_law.hpp). Its constants stand in the list of candidates.
#include "dem/laws/contact_law.hpp"
#include "dem/sphere_loop/sphere_pass.hpp"

namespace polargrain::dem {
namespace {

/// Whether the springs of a law may be these.
template <typename Kind>
constexpr bool has_spring(int place) {
  if (place < kBending) return true;
  if (place < kTorsion) return Kind::rolling != RollingLaw::off;
  if (place == kTorsion) return Kind::twists;
  return !Kind::bare && Kind::tangential == TangentialLaw::li_chu;
}

/// Two spheres as they meet.
template <typename Number>
struct Meeting {
  Vector<Number> delta;            ///< centre of the second to centre of the first, m
  Vector<Number> velocity;         ///< of the first against the second, m/s
  Number distance, over_distance;  ///< of the centres, m; one over it
  Vector<Number> spin_first, spin_second;
  Number radius_first, radius_second;
};

template <bool Hertz, typename Kind, typename Number_>
struct SphereContact {
  using Number = Number_;
  using Tangent = Vector<Number>;
  using Turn = Vector<Number>;

  const SpherePass& pass;
  long candidate;
  Number* springs;

  Vector<Number> n{}, slip_rate{};
  Vector<Number> spin{},
      own_spin{};  ///< of the first against the second, with the curvature and without it, rad/s
  Number twirl{};  ///< angle by which the pair turns about its normal in the step
  Number overlap{}, opening_rate{};           ///< m, m/s
  Number touching{};                          ///< 1, or 0
  Number arm_first{}, arm_second{};           ///< centre to contact point, m
  Number stiffening{}, viscous_stiffening{};  ///< Hertz: the root and the fourth root of the overlap

  /// @param step by which springs move, s
  POLARGRAIN_INLINE SphereContact(const SpherePass& given, long place, const Meeting<Number>& m, Number step,
                                  Number* kept)
      : pass(given), candidate(place), springs(kept) {
    const Number zero = all<Number>(0.0);
    const Number half = all<Number>(0.5);
    const Number reach = m.radius_first + m.radius_second;
    overlap = reach - m.distance;
    n = m.over_distance * m.delta;
    touching = select(dot(m.delta, m.delta) < reach * reach, all<Number>(1.0), zero);
    arm_first = m.radius_first - half * overlap;
    arm_second = m.radius_second - half * overlap;
    if constexpr (Hertz) {
      stiffening = root(greater(overlap, zero));
      if constexpr (!Kind::bare) viscous_stiffening = root(stiffening);
    }
    Vector<Number> spin_first = m.spin_first;
    Vector<Number> spin_second = m.spin_second;
    if (pass.bends) see_curvature(spin_first, spin_second, m.delta);
    if constexpr (Kind::rolling == RollingLaw::epsd2) own_spin = m.spin_first - m.spin_second;
    if constexpr (Kind::bends || Kind::tangential == TangentialLaw::li_chu) {
      spin = spin_first - spin_second;
      twirl = half * step * dot(spin_first + spin_second, n);
    }
    opening_rate = dot(m.velocity, n);
    slip_rate = m.velocity - opening_rate * n - cross(arm_first * spin_first + arm_second * spin_second, n);
  }

  POLARGRAIN_INLINE Vector<Number> flat(const Vector<Number>& a) const { return a - dot(a, n) * n; }
  /// About the normal, and into the new plane, keeping its length.
  POLARGRAIN_INLINE Vector<Number> turned(Vector<Number> spring) const {
    const Number old = dot(spring, spring);
    spring = flat(spring + twirl * cross(n, spring));
    return root(old / not_zero(dot(spring, spring))) * spring;
  }
  POLARGRAIN_INLINE Vector<Number> across(const Vector<Number>& turn) const { return cross(n, turn); }
  POLARGRAIN_INLINE Vector<Number> lever(const Vector<Number>& along) const { return cross(n, along); }
  POLARGRAIN_INLINE Number twist_rate() const { return dot(spin, n); }
  template <typename Some>
  POLARGRAIN_INLINE Some where_touching(const Some& a) const {
    return touching * a;
  }

  POLARGRAIN_INLINE Vector<Number> sliding() const { return spring(kSliding); }
  POLARGRAIN_INLINE void keep_sliding(const Vector<Number>& a) const { keep(kSliding, a); }
  POLARGRAIN_INLINE Vector<Number> rolled() const { return spring(kRollingDisplacement); }
  POLARGRAIN_INLINE void keep_rolled(const Vector<Number>& a) const { keep(kRollingDisplacement, a); }
  POLARGRAIN_INLINE Vector<Number> bending() const { return spring(kBending); }
  POLARGRAIN_INLINE void keep_bending(const Vector<Number>& a) const { keep(kBending, a); }
  POLARGRAIN_INLINE Number torsion() const { return springs[kTorsion]; }
  POLARGRAIN_INLINE void keep_torsion(Number a) const { springs[kTorsion] = a; }

  POLARGRAIN_INLINE void find_stiffnesses(bool damped, Stiffnesses<Number>& made) const {
    made.normal = stiffness(kNormalStiffness);
    made.tangential = stiffness(kTangentialStiffness);
    if (!damped) return;
    made.normal_dashpot = dashpot(kNormalDashpot);
    made.tangential_dashpot = dashpot(kTangentialDashpot);
  }
  POLARGRAIN_INLINE Number friction() const { return constant(kFriction); }
  POLARGRAIN_INLINE Number rolling_stiffness(Number) const { return stiffness(kRollingStiffness); }
  POLARGRAIN_INLINE Number rolling_reach() const { return constant(kRollingReach); }
  POLARGRAIN_INLINE Number rolling_dashpot(Number) const { return dashpot(kRollingDashpot); }
  POLARGRAIN_INLINE Number harmonic() const { return constant(kHarmonicRadius); }
  POLARGRAIN_INLINE Number force_stiffness(Number) const { return stiffness(kForceStiffness); }
  POLARGRAIN_INLINE Number force_friction() const { return constant(kForceFriction); }
  POLARGRAIN_INLINE Number force_dashpot(Number) const { return dashpot(kForceDashpot); }

 private:
  POLARGRAIN_INLINE Number constant(SphereConstant which) const {
    return load<Number>(pass.constants[which] + candidate);
  }
  POLARGRAIN_INLINE Number stiffness(SphereConstant which) const {
    if constexpr (Hertz) return constant(which) * stiffening;
    return constant(which);
  }
  POLARGRAIN_INLINE Number dashpot(SphereConstant which) const {
    if constexpr (Hertz) return constant(which) * viscous_stiffening;
    return constant(which);
  }
  POLARGRAIN_INLINE Vector<Number> spring(int place) const {
    return {springs[place], springs[place + 1], springs[place + 2]};
  }
  POLARGRAIN_INLINE void keep(int place, const Vector<Number>& a) const {
    springs[place] = a.x;
    springs[place + 1] = a.y;
    springs[place + 2] = a.z;
  }
  POLARGRAIN_INLINE void see_curvature(Vector<Number>& first, Vector<Number>& second,
                                       const Vector<Number>& delta) const {
    const double* const k = pass.curvature_rate;
    const auto half = [&](int axis) {
      return all<Number>(0.5) * (all<Number>(k[3 * axis]) * delta.x + all<Number>(k[3 * axis + 1]) * delta.y +
                                 all<Number>(k[3 * axis + 2]) * delta.z);
    };
    const Vector<Number> bent{half(0), half(1), half(2)};
    first = first + bent;
    second = second - bent;
  }
};

}  // namespace
}  // namespace polargrain::dem
