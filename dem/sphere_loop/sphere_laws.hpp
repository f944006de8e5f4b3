// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The contact laws of docs/theory/grains.md, D.2 between spheres. The normal n points from the second to the first, as
// in the engine, whose headers hold the same laws; tests hold both side by side. The law is written for numbers of any
// lanes. It has no branch that depends on a contact: a pair that has parted pushes with no force, so that every limit
// is zero, and a spring cut to its limit is forgotten.
#include "dem/lanes/vectors.hpp"
#include "dem/sphere_loop/sphere_pass.hpp"

namespace polargrain::dem {
namespace {

// As enum classes of combination.hpp, whose numbers they have; that header includes others.
inline constexpr int kHistory = 0, kSlidingLiChu = 1;
inline constexpr int kRollingOff = 0, kEpsd2 = 1, kRollingLiChu = 2, kRollingLiChuWithTorsion = 3;

template <int Width_, bool Hertz_, int Tangential_, int Rolling_, bool Bare_>
struct LawKind {
  static constexpr int width = Width_;
  static constexpr bool hertz = Hertz_;
  static constexpr int tangential = Tangential_;
  static constexpr int rolling = Rolling_;
  static constexpr bool bare = Bare_;  ///< every one of SphereSettings is off, but the torsion of li_chu
  static constexpr bool bends = Rolling_ >= kRollingLiChu;
  static constexpr bool twists = Rolling_ == kRollingLiChuWithTorsion;
  /// The springs that the law has may be these.
  static constexpr bool has_spring(int place) {
    if (place < kBending) return true;
    if (place < kTorsion) return Rolling_ != kRollingOff;
    if (place == kTorsion) return twists;
    return !Bare_ && Tangential_ == kSlidingLiChu;
  }
};

/// Two spheres as they meet.
template <typename Number>
struct Meeting {
  Vector<Number> delta;            ///< centre of the second to centre of the first, m
  Vector<Number> velocity;         ///< of the first against the second, m/s
  Number distance, over_distance;  ///< of the centres, m; one over it
  Vector<Number> spin_first, spin_second;
  Number radius_first, radius_second;
};

/// The answer of the law.
template <typename Number>
struct Meant {
  Vector<Number> force, moment;  ///< force on the first; rolling resistance on the second
  Number arm_first, arm_second;
  Vector<Number> turning;  ///< n x tangential force
  Number touching, normal_stiffness, tangential_stiffness, normal_dashpot, tangential_dashpot;
  Number rolling_stiffness, rolling_limit, is_rolling, is_twisting;
};

/// A safe divisor: `a` may be zero where the quotient is not used, or its numerator is zero too.
template <typename Number>
POLARGRAIN_INLINE Number not_zero(Number a) {
  return greater(a, all<Number>(1e-290));
}
template <typename Number>
POLARGRAIN_INLINE Number length(const Vector<Number>& a) {
  return root(dot(a, a));
}
/// Factor that cuts a length to a limit.
template <typename Number>
POLARGRAIN_INLINE Number cutting(Number length, Number limit) {
  return lesser(all<Number>(1.0), limit / not_zero(length));
}

/// Turns a spring of the contact plane with the contact: about the normal, and into the new plane, keeping its length.
template <typename Number>
POLARGRAIN_INLINE Vector<Number> turned(Vector<Number> spring, const Vector<Number>& n, Number twirl) {
  const Number old = dot(spring, spring);
  spring = spring + twirl * cross(n, spring);
  spring = spring - dot(spring, n) * n;
  return root(old / not_zero(dot(spring, spring))) * spring;
}

/// The law at work on one contact a lane.
template <typename Kind, typename Number>
struct Law {
  const SpherePass& pass;
  long candidate;
  Number step;  ///< by which springs move, s
  Number* springs;

  Vector<Number> n{}, slip_rate{};
  Vector<Number> spin{};      // of the first against the second, with the curvature
  Vector<Number> own_spin{};  // without it
  Number twirl{};             // angle by which the pair has turned about its normal in the step
  Number push{}, size{};      // compressive normal force; magnitude of the normal force
  Number touching{};          // 1, or 0
  Number stiffening{}, viscous_stiffening{};  // Hertz: the root and the fourth root of the overlap

  POLARGRAIN_INLINE Number constant(SphereConstant which) const {
    return load<Number>(pass.constants[which] + candidate);
  }
  POLARGRAIN_INLINE Number stiffness(SphereConstant which) const {
    if constexpr (Kind::hertz) return constant(which) * stiffening;
    return constant(which);
  }
  POLARGRAIN_INLINE Number dashpot(SphereConstant which) const {
    if constexpr (Kind::hertz) return constant(which) * viscous_stiffening;
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
  /// A dashpot acts where spheres touch and its spring does not stand at its limit.
  template <typename Choice>
  POLARGRAIN_INLINE Number viscous(Number dashpot, Choice is_at_limit) const {
    return select(is_at_limit, all<Number>(0.0), dashpot * touching);
  }

  POLARGRAIN_INLINE Vector<Number> history(const Meant<Number>& made) const {
    Vector<Number> s = spring(kSliding) + step * slip_rate;
    s = s - dot(s, n) * n;
    const Number elastic = made.tangential_stiffness * length(s);
    const Number limit = constant(kFriction) * size;
    s = cutting(elastic, limit) * s;
    keep(kSliding, s);
    Vector<Number> force = (-made.tangential_stiffness) * s;
    if constexpr (!Kind::bare)
      if (pass.settings.damped) force = force - viscous(made.tangential_dashpot, elastic > limit) * slip_rate;
    return force;
  }

  POLARGRAIN_INLINE Vector<Number> sliding_li_chu(const Meant<Number>& made) const {
    const Number limit = constant(kFriction) * push;
    Vector<Number> s = turned(spring(kSliding), n, twirl) + step * slip_rate;
    s = s - dot(s, n) * n;
    const Number kt = made.tangential_stiffness;
    const Number size_before = kt * length(s);
    if constexpr (!Kind::bare)
      if (pass.settings.rolling_force)
        return with_rolling_force(made, s, cutting(size_before, limit) * (kt * s), limit);
    const Vector<Number> kept = cutting(size_before, limit) * s;
    keep(kSliding, kept);
    Vector<Number> force = (-kt) * kept;
    if constexpr (!Kind::bare)
      if (pass.settings.damped) {
        force = force - viscous(made.tangential_dashpot, size_before > limit) * slip_rate;
        // A dashpot cannot push past the friction of the surfaces either.
        force = cutting(length(force), limit) * force;
      }
    return force;
  }

  POLARGRAIN_INLINE Vector<Number> with_rolling_force(const Meant<Number>& made, const Vector<Number>& s,
                                                      Vector<Number> elastic, Number limit) const {
    const Number kt = made.tangential_stiffness;
    const Number kr = stiffness(kForceStiffness);
    const Number radius = constant(kHarmonicRadius);
    const Number sliding_before = kt * length(s);
    Vector<Number> rolling{};
    bool coupled = false;
    if constexpr (Kind::bends) coupled = pass.settings.symmetric;
    if (coupled) {
      if constexpr (Kind::bends) rolling = (kr * radius) * cross(n, bending_ahead());
    } else {
      const Vector<Number> rate = radius * cross(n, spin);  // of the rolling displacement
      const Vector<Number> rolled = turned(spring(kRollingDisplacement), n, twirl) + step * rate;
      const Number largest = constant(kForceFriction) * push;
      const Number before = kr * length(rolled);
      const Vector<Number> kept = cutting(before, largest) * rolled;
      keep(kRollingDisplacement, kept);
      rolling = kr * kept;
    }
    elastic = elastic + rolling;
    const Number both = length(elastic);
    elastic = cutting(both, limit) * elastic;
    const auto slides = (sliding_before > limit) | (both > limit);
    const Number over = all<Number>(1.0) / not_zero(kt);
    const auto given_way = [&](Number part, Number rolling_part, Number old) {
      return touching * select(slides, (part - rolling_part) * over, old);
    };
    keep(kSliding, {given_way(elastic.x, rolling.x, s.x), given_way(elastic.y, rolling.y, s.y),
                    given_way(elastic.z, rolling.z, s.z)});
    Vector<Number> force = (-all<Number>(1.0)) * elastic;
    if (pass.settings.damped) force = force - viscous(made.tangential_dashpot, slides) * slip_rate;
    return cutting(length(force), limit) * force;
  }

  /// The bending spring as the rolling law finds it in this step, which comes after the sliding one.
  POLARGRAIN_INLINE Vector<Number> bending_ahead() const {
    return turned(spring(kBending), n, twirl) + step * (spin - dot(spin, n) * n);
  }

  POLARGRAIN_INLINE Vector<Number> epsd2(Meant<Number>& made) const {
    made.rolling_stiffness = stiffness(kRollingStiffness);
    made.rolling_limit = constant(kRollingReach) * size;
    Vector<Number> way = own_spin;
    bool whole = false;
    if constexpr (!Kind::bare) whole = pass.settings.torsion;
    if (!whole) way = way - dot(way, n) * n;
    // As in the engine, which looks a step ahead even where it does not keep it.
    Vector<Number> moment = spring(kBending) + (made.rolling_stiffness * all<Number>(pass.step)) * way;
    moment = cutting(length(moment), made.rolling_limit) * moment;
    keep(kBending, moment);
    return moment;
  }

  POLARGRAIN_INLINE Vector<Number> rolling_li_chu(Meant<Number>& made) const {
    const Number stiff = stiffness(kRollingStiffness);
    const Number limit = constant(kRollingReach) * push;
    made.rolling_stiffness = stiff;
    made.rolling_limit = limit;
    const Number one = all<Number>(1.0);
    const Number zero = all<Number>(0.0);
    const Number twist_rate = dot(spin, n);
    bool coupled = false;
    if constexpr (!Kind::bare) coupled = pass.settings.symmetric;
    Vector<Number> bending = bending_ahead();
    Vector<Number> moment = stiff * bending;
    Vector<Number> coupling{zero, zero, zero};
    if (coupled) {
      coupling = (stiffness(kForceStiffness) * constant(kHarmonicRadius)) * cross(n, spring(kSliding));
      moment = moment - coupling;
    }
    const Number square = dot(moment, moment);
    const auto at_limit = square > limit * limit;  // as the engine has it
    const Number factor = cutting(root(square), limit);
    moment = factor * moment;
    if (coupled) {
      const Number over = one / not_zero(stiff);
      const auto given_way = [&](Number part, Number of_sliding, Number old) {
        return touching * select(at_limit, (part + of_sliding) * over, old);
      };
      bending = {given_way(moment.x, coupling.x, bending.x), given_way(moment.y, coupling.y, bending.y),
                 given_way(moment.z, coupling.z, bending.z)};
    } else {
      bending = factor * bending;
    }
    keep(kBending, bending);
    made.is_rolling = select(at_limit, one, zero);
    if constexpr (Kind::twists) {
      const Number angle = springs[kTorsion] + step * twist_rate;
      const Number torque_before = magnitude(stiff * angle);
      springs[kTorsion] = cutting(torque_before, limit) * angle;
      const Number torque = stiff * springs[kTorsion];
      made.is_twisting = select(torque_before > limit, one, zero);
      moment = moment + torque * n;
    }
    return moment;
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

  POLARGRAIN_INLINE Meant<Number> operator()(const Meeting<Number>& m) {
    const Number zero = all<Number>(0.0);
    const Number half = all<Number>(0.5);
    Meant<Number> made{};
    const Number square = dot(m.delta, m.delta);
    const Number reach = m.radius_first + m.radius_second;
    const Number overlap = reach - m.distance;
    n = m.over_distance * m.delta;
    touching = select(square < reach * reach, all<Number>(1.0), zero);
    made.touching = touching;
    made.arm_first = m.radius_first - half * overlap;
    made.arm_second = m.radius_second - half * overlap;
    if constexpr (Kind::hertz) stiffening = root(greater(overlap, zero));

    Vector<Number> spin_first = m.spin_first;
    Vector<Number> spin_second = m.spin_second;
    if (pass.bends) see_curvature(spin_first, spin_second, m.delta);
    if constexpr (Kind::rolling == kEpsd2) own_spin = m.spin_first - m.spin_second;
    if constexpr (Kind::bends || Kind::tangential == kSlidingLiChu) {
      spin = spin_first - spin_second;
      twirl = half * step * dot(spin_first + spin_second, n);
    }
    const Number opening_rate = dot(m.velocity, n);
    slip_rate =
        m.velocity - opening_rate * n - cross(made.arm_first * spin_first + made.arm_second * spin_second, n);

    made.normal_stiffness = stiffness(kNormalStiffness);
    made.tangential_stiffness = stiffness(kTangentialStiffness);
    Number normal = made.normal_stiffness * overlap;
    if constexpr (Kind::bare) {
      push = size = normal = greater(normal, zero);
    } else {
      if constexpr (Kind::hertz) viscous_stiffening = root(stiffening);
      if (pass.settings.damped) {
        made.normal_dashpot = dashpot(kNormalDashpot);
        made.tangential_dashpot = dashpot(kTangentialDashpot);
        normal = normal - made.normal_dashpot * opening_rate;
      }
      if (pass.settings.limit_force) normal = greater(normal, zero);
      normal = select(touching > zero, normal, zero);
      push = greater(normal, zero);
      size = magnitude(normal);
    }

    const Vector<Number> tangential = Kind::tangential == kHistory ? history(made) : sliding_li_chu(made);
    made.force = normal * n + tangential;
    made.turning = cross(n, tangential);
    if constexpr (Kind::rolling == kEpsd2) made.moment = epsd2(made);
    if constexpr (Kind::bends) made.moment = rolling_li_chu(made);
    return made;
  }
};

}  // namespace
}  // namespace polargrain::dem
