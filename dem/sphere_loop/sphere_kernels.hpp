// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The passes of the loop over spheres for numbers of some lanes. Included by one file for each instruction set.
#include "dem/sphere_loop/sphere_laws.hpp"

namespace polargrain::dem {
namespace {

template <typename Kind>
struct PassOf {
  using Number = Lanes<Kind::width>;

  /// Everything of as many candidates as there are lanes.
  template <bool Across>
  POLARGRAIN_INLINE static void treat(const SpherePass& pass, int c) {
    Number place_a[4], place_b[4], velocity_a[4], velocity_b[4], spin_a[4], spin_b[4];
    load_columns<kGrainStride>(pass.grains, pass.first + c, place_a);
    load_columns<kGrainStride>(pass.grains, pass.second + c, place_b);
    load_columns<kGrainStride>(pass.grains + 4, pass.first + c, velocity_a);
    load_columns<kGrainStride>(pass.grains + 4, pass.second + c, velocity_b);
    load_columns<kGrainStride>(pass.grains + 8, pass.first + c, spin_a);
    load_columns<kGrainStride>(pass.grains + 8, pass.second + c, spin_b);
    Meeting<Number> meeting;
    meeting.delta = {place_a[0] - place_b[0], place_a[1] - place_b[1], place_a[2] - place_b[2]};
    meeting.velocity = {velocity_a[0] - velocity_b[0], velocity_a[1] - velocity_b[1],
                        velocity_a[2] - velocity_b[2]};
    if constexpr (Across) {
      Number place[4], velocity[4];
      load_columns<kImageStride>(pass.images, pass.image + c, place);
      load_columns<kImageStride>(pass.images + 4, pass.image + c, velocity);
      meeting.delta = meeting.delta - Vector<Number>{place[0], place[1], place[2]};
      meeting.velocity = meeting.velocity - Vector<Number>{velocity[0], velocity[1], velocity[2]};
    }
    meeting.spin_first = {spin_a[0], spin_a[1], spin_a[2]};
    meeting.spin_second = {spin_b[0], spin_b[1], spin_b[2]};
    meeting.radius_first = place_a[3];
    meeting.radius_second = place_b[3];

    Number springs[kSphereSprings];
    for (int k = 0; k < kSphereSprings; ++k)
      if (Kind::has_spring(k)) springs[k] = load<Number>(pass.springs[k] + c);
    Law<Kind, Number> law{pass, c, all<Number>(pass.advance ? pass.step : 0.0), springs};
    const Meant<Number> made = law(meeting);
    if (pass.advance)
      for (int k = 0; k < kSphereSprings; ++k)
        if (Kind::has_spring(k)) store(pass.springs[k] + c, springs[k]);
    Vector<Number> torque_a = (-made.arm_first) * made.turning;
    Vector<Number> torque_b = (-made.arm_second) * made.turning;
    if constexpr (Kind::rolling != kRollingOff) {
      torque_a = torque_a - made.moment;
      torque_b = torque_b + made.moment;
    }
    RowOfLane<Kind::width> force[Kind::width], rows_a[Kind::width], rows_b[Kind::width];
    rows_of(made.force, force);
    rows_of(torque_a, rows_a);
    rows_of(torque_b, rows_b);
    for (int lane = 0; lane < Kind::width; ++lane) {
      double* const a = pass.forces + static_cast<long>(pass.first[c + lane]) * kForceStride;
      double* const b = pass.forces + static_cast<long>(pass.second[c + lane]) * kForceStride;
      force[lane].add_to(a);
      rows_a[lane].add_to(a + 4);
      force[lane].take_from(b);
      rows_b[lane].add_to(b + 4);
    }
    if (pass.records) take_down(pass, c, meeting, made);
  }

  POLARGRAIN_INLINE static void take_down(const SpherePass& pass, int c, const Meeting<Number>& meeting,
                                          const Meant<Number>& made) {
    double* const out = pass.records + static_cast<long>(c / kBlock) * (kBlock * kSphereRecords) + c % kBlock;
    const auto put = [out](int which, Number value) { store(out + which * kBlock, value); };
    const auto put_vector = [&put](int which, const Vector<Number>& a) {
      put(which, a.x);
      put(which + 1, a.y);
      put(which + 2, a.z);
    };
    put(kIsTouching, made.touching);
    put_vector(kDelta, meeting.delta);
    put_vector(kForce, made.force);
    put_vector(kMoment, made.moment);
    put(kArms, made.arm_first);
    put(kArms + 1, made.arm_second);
    put(kStiffnesses, made.normal_stiffness);
    put(kStiffnesses + 1, made.tangential_stiffness);
    put(kDashpots, made.normal_dashpot);
    put(kDashpots + 1, made.tangential_dashpot);
    put(kRolling, made.rolling_stiffness);
    put(kRollingLimit, made.rolling_limit);
    put(kIsRolling, made.is_rolling);
    put(kIsTwisting, made.is_twisting);
  }

  /// Whether any pair of a block touches.
  template <bool Across>
  POLARGRAIN_INLINE static bool touches(const SpherePass& pass, int begin) {
    bool found = false;
    for (int c = begin; c < begin + kBlock; c += Kind::width) {
      Number a[4], b[4];
      load_columns<kGrainStride>(pass.grains, pass.first + c, a);
      load_columns<kGrainStride>(pass.grains, pass.second + c, b);
      Vector<Number> delta{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
      if constexpr (Across) {
        Number place[4];
        load_columns<kImageStride>(pass.images, pass.image + c, place);
        delta = delta - Vector<Number>{place[0], place[1], place[2]};
      }
      const Number reach = a[3] + b[3];
      found = any(dot(delta, delta) < reach * reach) || found;
    }
    return found;
  }

  template <bool Across>
  POLARGRAIN_INLINE static void zones(const SpherePass& pass, int begin, int touching, int end) {
    for (int c = begin; c < touching; c += Kind::width) treat<Across>(pass, c);
    for (int c = touching; c < end && pass.gaps[c / kBlock] <= pass.reach; c += kBlock) {
      const bool now = touches<Across>(pass, c);
      // Those that have just parted forget their springs.
      if (now || pass.active[c / kBlock])
        for (int lane = 0; lane < kBlock; lane += Kind::width) treat<Across>(pass, c + lane);
      if (pass.advance) pass.active[c / kBlock] = now;
    }
  }

  static void run(const SpherePass& given) {
    const SpherePass pass = given;  // a copy that no store can alias
    zones<false>(pass, 0, pass.touching, pass.interior);
    zones<true>(pass, pass.interior, pass.touching_across, pass.count);
  }
};

template <typename Numbers>
POLARGRAIN_INLINE Numbers three(const double* from) {
  const double row[4] = {from[0], from[1], from[2], 0.0};
  Numbers made;
  read(row, made);
  return made;
}

/// A matrix that is multiplied with a vector.
template <typename Numbers>
struct Columns {
  Numbers first, second, third;
  POLARGRAIN_INLINE explicit Columns(const double* matrix)
      : first(three<Numbers>(matrix)),
        second(three<Numbers>(matrix + 3)),
        third(three<Numbers>(matrix + 6)) {}
  POLARGRAIN_INLINE Numbers operator*(const Numbers& a) const { return combined(first, second, third, a); }
};

/// Second half of a step of one grain: damping against the affine flow, half a kick.
template <typename Numbers>
struct Ending {
  double half, rate;
  Columns<Numbers> gradient;
  Numbers flow_spin;
  POLARGRAIN_INLINE explicit Ending(const SphereMotion& motion)
      : half(0.5 * motion.step),
        rate(motion.damping_rate),
        gradient(motion.gradient),
        flow_spin(three<Numbers>(motion.spin)) {}

  POLARGRAIN_INLINE void apply(const SphereMotion& motion, int k, const Numbers& place, Numbers& velocity,
                               Numbers& spin, Numbers& acceleration, Numbers& angular) const {
    const double* const row = motion.forces + static_cast<long>(k) * kForceStride;
    Numbers force, torque;
    read(row, force);
    read(row + 4, torque);
    acceleration = motion.inverse_mass[k] * force - rate * (velocity - gradient * place);
    angular = motion.inverse_inertia[k] * torque - rate * (spin - flow_spin);
    velocity = velocity + half * acceleration;
    spin = spin + half * angular;
  }
};

template <typename Numbers, bool Ends>
double begin_each(const SphereMotion& given) {
  const SphereMotion motion = given;
  const Ending<Numbers> ending(motion);
  const Columns<Numbers> change(motion.change), flow(motion.flow), to_laboratory(motion.turn_of_spin);
  const Numbers change_of_spin = three<Numbers>(motion.change_of_spin), turn = three<Numbers>(motion.turn);
  const double step = motion.step, half = 0.5 * step;
  const double zeros[3] = {0.0, 0.0, 0.0};
  const Numbers zero = three<Numbers>(zeros);
  double fastest = 0.0;
  for (int k = 0; k < motion.count; ++k) {
    double* const grain = motion.grains + static_cast<long>(k) * kGrainStride;
    double* const force = motion.forces + static_cast<long>(k) * kForceStride;
    double* const sum = motion.turned + static_cast<long>(k) * 4;
    Numbers place, velocity, spin, acceleration, angular, turned;
    read(grain, place);
    read(grain + 4, velocity);
    read(grain + 8, spin);
    if constexpr (Ends) {
      ending.apply(motion, k, place, velocity, spin, acceleration, angular);
    } else {
      const double* const kick = motion.accelerations + static_cast<long>(k) * kForceStride;
      read(kick, acceleration);
      read(kick + 4, angular);
    }
    velocity = velocity + change * place;
    spin = spin + change_of_spin;
    velocity = velocity + half * acceleration;
    spin = spin + half * angular;
    fastest = greater(fastest, square_of(velocity - flow * place));
    place = place + step * velocity;
    write(grain, place);
    write(grain + 4, velocity);
    write(grain + 8, spin);
    read(sum, turned);
    write(sum, turned + (to_laboratory * spin + turn));
    write(force, zero);
    write(force + 4, zero);
  }
  return fastest;
}

template <typename Numbers>
double begin_a_step(const SphereMotion& motion, bool ends) {
  return ends ? begin_each<Numbers, true>(motion) : begin_each<Numbers, false>(motion);
}

template <typename Numbers>
void end_a_step(const SphereMotion& given) {
  const SphereMotion motion = given;
  const Ending<Numbers> ending(motion);
  for (int k = 0; k < motion.count; ++k) {
    double* const grain = motion.grains + static_cast<long>(k) * kGrainStride;
    double* const kick = motion.accelerations + static_cast<long>(k) * kForceStride;
    Numbers place, velocity, spin, acceleration, angular;
    read(grain, place);
    read(grain + 4, velocity);
    read(grain + 8, spin);
    ending.apply(motion, k, place, velocity, spin, acceleration, angular);
    write(grain + 4, velocity);
    write(grain + 8, spin);
    write(kick, acceleration);
    write(kick + 4, angular);
  }
}

template <int Width, bool Hertz, int Tangential, int Rolling>
POLARGRAIN_INLINE void list_settings(SphereKernels& kernels) {
  kernels.pass[Hertz][Tangential][Rolling][0] =
      &PassOf<LawKind<Width, Hertz, Tangential, Rolling, false>>::run;
  kernels.pass[Hertz][Tangential][Rolling][1] =
      &PassOf<LawKind<Width, Hertz, Tangential, Rolling, true>>::run;
}
template <int Width, bool Hertz, int Tangential>
POLARGRAIN_INLINE void list_rolling(SphereKernels& kernels) {
  list_settings<Width, Hertz, Tangential, kRollingOff>(kernels);
  list_settings<Width, Hertz, Tangential, kEpsd2>(kernels);
  list_settings<Width, Hertz, Tangential, kRollingLiChu>(kernels);
  list_settings<Width, Hertz, Tangential, kRollingLiChuWithTorsion>(kernels);
}
template <int Width>
POLARGRAIN_INLINE SphereKernels kernels_of_lanes() {
  SphereKernels kernels{};
  list_rolling<Width, false, kHistory>(kernels);
  list_rolling<Width, false, kSlidingLiChu>(kernels);
  list_rolling<Width, true, kHistory>(kernels);
  list_rolling<Width, true, kSlidingLiChu>(kernels);
  using Numbers = typename OneGrain<Width>::Numbers;
  kernels.begin_step = &begin_a_step<Numbers>;
  kernels.end_step = &end_a_step<Numbers>;
  return kernels;
}

}  // namespace
}  // namespace polargrain::dem
