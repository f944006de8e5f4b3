// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The passes of the loop over spheres for numbers of some lanes. Included by one file for each instruction set.
#include "dem/sphere_loop/sphere_contact.hpp"

namespace polargrain::dem {
namespace {

template <int Width, bool Hertz, typename Kind>
struct PassOf {
  using Number = Lanes<Width>;
  using Contact = SphereContact<Hertz, Kind, Number>;

  /// Candidates that are treated before their forces are summed up: the processor then has several of them in hand.
  static constexpr int kStretch = 64;
  static constexpr int kMeetings = 8;  // difference of places, of velocities, distance, one over it
  struct Stretch {
    alignas(64) double meetings[kMeetings][kStretch];
    RowOfLane<Width> force[kStretch], torque_first[kStretch],
        torque_second[kStretch];  // force on the first
  };

  /// @param grain the number at which its rows begin. A processor multiplies by such a small power of two on the way.
  POLARGRAIN_INLINE static double* force_at(const SpherePass& pass, unsigned grain) {
    constexpr unsigned long kBytes = kForceStride * sizeof(double) / kGrainStride;
    return reinterpret_cast<double*>(reinterpret_cast<char*>(pass.forces) + kBytes * grain);
  }

  /// Row `row` of the first grain less that of the second, and of its image: taken before rows become columns.
  template <bool Across>
  POLARGRAIN_INLINE static void apart(const SpherePass& pass, int c, int row, Number (&columns)[4]) {
    columns_of(
        [&pass, c, row]<typename Part>(int lane, int k, Part) POLARGRAIN_INLINE_LAMBDA {
          const Part made = load<Part>(pass.grains + pass.first[c + lane] + row + k) -
                            load<Part>(pass.grains + pass.second[c + lane] + row + k);
          if constexpr (Across)
            return made - load<Part>(pass.images + pass.image[c + lane] + row + k);
          else
            return made;
        },
        columns);
  }

  /// Columns of row `row` of grains.
  POLARGRAIN_INLINE static void columns_of_grains(const SpherePass& pass, const unsigned* grains, int row,
                                                  Number (&columns)[4]) {
    columns_of([&pass, grains, row]<typename Part>(int lane, int k, Part)
                   POLARGRAIN_INLINE_LAMBDA { return load<Part>(pass.grains + grains[lane] + row + k); },
               columns);
  }

  /// Where as many candidates as there are lanes lie and how they move. Roots and quotients take long: nothing waits for
  /// them before the next candidates are under way. @param k where in the stretch
  template <bool Across>
  POLARGRAIN_INLINE static void approach(const SpherePass& pass, int c, Stretch& stretch, int k) {
    Number place[4], velocity[4];
    apart<Across>(pass, c, 0, place);
    apart<Across>(pass, c, 4, velocity);
    const Vector<Number> delta{place[0], place[1], place[2]};
    const Number distance = root(dot(delta, delta));
    const Number made[] = {delta.x,     delta.y,     delta.z,  velocity[0],
                           velocity[1], velocity[2], distance, all<Number>(1.0) / distance};
    for (int which = 0; which < kMeetings; ++which) store(stretch.meetings[which] + k, made[which]);
  }

  POLARGRAIN_INLINE static Meeting<Number> meet(const SpherePass& pass, int c, const Stretch& stretch,
                                                int k) {
    const auto known = [&stretch, k](int which)
                           POLARGRAIN_INLINE_LAMBDA { return load<Number>(stretch.meetings[which] + k); };
    Number spin_a[4], spin_b[4];
    columns_of_grains(pass, pass.first + c, 8, spin_a);
    columns_of_grains(pass, pass.second + c, 8, spin_b);
    Meeting<Number> meeting;
    meeting.delta = {known(0), known(1), known(2)};
    meeting.velocity = {known(3), known(4), known(5)};
    meeting.distance = known(6);
    meeting.over_distance = known(7);
    meeting.spin_first = {spin_a[0], spin_a[1], spin_a[2]};
    meeting.spin_second = {spin_b[0], spin_b[1], spin_b[2]};
    meeting.radius_first = load<Number>(pass.radius_first + c);
    meeting.radius_second = load<Number>(pass.radius_second + c);
    return meeting;
  }

  POLARGRAIN_INLINE static void treat(const SpherePass& pass, int c, Stretch& stretch, int k) {
    const Meeting<Number> meeting = meet(pass, c, stretch, k);
    Number springs[kSphereSprings];
    for (int which = 0; which < kSphereSprings; ++which)
      if (has_spring<Kind>(which)) springs[which] = load<Number>(pass.springs[which] + c);
    const Number step = all<Number>(pass.advance ? pass.step : 0.0);
    ContactLaw<Kind, Contact> law(pass.settings, pass.step, pass.advance, pass, c, meeting, step,
                                  &springs[0]);
    const LawAnswer<Contact> made = law();
    const Contact& contact = law.contact;
    if (pass.advance)
      for (int which = 0; which < kSphereSprings; ++which)
        if (has_spring<Kind>(which)) store(pass.springs[which] + c, springs[which]);
    const Vector<Number> force = made.normal * contact.n - made.resistance;
    const Vector<Number> turning = cross(contact.n, made.resistance);
    Vector<Number> torque_a = contact.arm_first * turning;
    Vector<Number> torque_b = contact.arm_second * turning;
    if constexpr (Kind::rolling != RollingLaw::off) {
      torque_a = torque_a - made.moment;
      torque_b = torque_b + made.moment;
    }
    RowOfLane<Width> rows[Width];
    const auto keep = [&rows, k](const Vector<Number>& answer, RowOfLane<Width>* to)
                          POLARGRAIN_INLINE_LAMBDA {
                            rows_of(answer, rows);
                            for (int lane = 0; lane < Width; ++lane) to[k + lane] = rows[lane];
                          };
    keep(force, stretch.force);
    keep(torque_a, stretch.torque_first);
    keep(torque_b, stretch.torque_second);
    if (pass.records) take_down(pass, c, meeting, contact, force, made);
  }

  /// Adds the answers of as many candidates as there are lanes to the forces on their grains.
  POLARGRAIN_INLINE static void sum_up(const SpherePass& pass, int c, const Stretch& stretch, int k) {
    for (int lane = 0; lane < Width; ++lane) {
      double* const a = force_at(pass, pass.first[c + lane]);
      double* const b = force_at(pass, pass.second[c + lane]);
      stretch.force[k + lane].add_to(a);
      stretch.torque_first[k + lane].add_to(a + 4);
      stretch.force[k + lane].take_from(b);
      stretch.torque_second[k + lane].add_to(b + 4);
    }
  }

  /// Candidates `begin` to `end`, those of the stretches summed up in their order.
  template <bool Across>
  POLARGRAIN_INLINE static void treat_all(const SpherePass& pass, Stretch& stretch, int begin, int end) {
    int count = 0;
    for (int from = begin; from < end; from += kStretch) {
      count = end - from < kStretch ? end - from : kStretch;
      // Sums wait for those before them, quotients for the divider: side by side they cost one of the two.
      const int summed = from > begin ? kStretch : 0;
      for (int k = 0; k < kStretch; k += Width) {
        if (k < summed) sum_up(pass, from - kStretch + k, stretch, k);
        if (k < count) approach<Across>(pass, from + k, stretch, k);
      }
      for (int k = 0; k < count; k += Width) treat(pass, from + k, stretch, k);
    }
    for (int k = 0; k < count; k += Width) sum_up(pass, end - count + k, stretch, k);
  }

  POLARGRAIN_INLINE static void take_down(const SpherePass& pass, int c, const Meeting<Number>& meeting,
                                          const Contact& contact, const Vector<Number>& force,
                                          const LawAnswer<Contact>& made) {
    double* const out = pass.records + static_cast<long>(c / kBlock) * (kBlock * kSphereRecords) + c % kBlock;
    const auto put = [out](int which, Number value) { store(out + which * kBlock, value); };
    const auto put_vector = [&put](int which, const Vector<Number>& a) {
      put(which, a.x);
      put(which + 1, a.y);
      put(which + 2, a.z);
    };
    put(kIsTouching, contact.touching);
    put_vector(kDelta, meeting.delta);
    put_vector(kForce, force);
    put_vector(kMoment, made.moment);
    put(kArms, contact.arm_first);
    put(kArms + 1, contact.arm_second);
    put(kStiffnesses, made.stiff.normal);
    put(kStiffnesses + 1, made.stiff.tangential);
    put(kDashpots, made.stiff.normal_dashpot);
    put(kDashpots + 1, made.stiff.tangential_dashpot);
    put(kRolling, made.rolling_stiffness);
    put(kRollingLimit, made.rolling_limit);
    put(kIsRolling, made.is_rolling);
    put(kIsTwisting, made.is_twisting);
  }

  /// Whether any pair of a block touches.
  template <bool Across>
  POLARGRAIN_INLINE static bool touches(const SpherePass& pass, int begin) {
    bool found = false;
    for (int c = begin; c < begin + kBlock; c += Width) {
      Number place[4];
      apart<Across>(pass, c, 0, place);
      const Vector<Number> delta{place[0], place[1], place[2]};
      const Number reach = load<Number>(pass.radius_first + c) + load<Number>(pass.radius_second + c);
      found = any(dot(delta, delta) < reach * reach) || found;
    }
    return found;
  }

  template <bool Across>
  POLARGRAIN_INLINE static void zones(const SpherePass& pass, Stretch& stretch, int begin, int touching,
                                      int end) {
    treat_all<Across>(pass, stretch, begin, touching);
    for (int c = touching; c < end && pass.gaps[c / kBlock] <= pass.reach; c += kBlock) {
      const bool now = touches<Across>(pass, c);
      // Those that have just parted forget their springs.
      if (now || pass.active[c / kBlock]) treat_block<Across>(pass, stretch, c);
      if (pass.advance) pass.active[c / kBlock] = now;
    }
  }

  template <bool Across>
  POLARGRAIN_INLINE static void treat_block(const SpherePass& pass, Stretch& stretch, int c) {
    for (int k = 0; k < kBlock; k += Width) approach<Across>(pass, c + k, stretch, k);
    for (int k = 0; k < kBlock; k += Width) treat(pass, c + k, stretch, k);
    for (int k = 0; k < kBlock; k += Width) sum_up(pass, c + k, stretch, k);
  }

  static void run(const SpherePass& given) {
    const SpherePass pass = given;  // a copy that no store can alias
    Stretch stretch;
    zones<false>(pass, stretch, 0, pass.touching, pass.interior);
    zones<true>(pass, stretch, pass.interior, pass.touching_across, pass.count);
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

template <int Width, bool Hertz, TangentialLaw Tangential, RollingLaw Rolling, bool Twists>
POLARGRAIN_INLINE void list_settings(SphereKernels& kernels) {
  auto& pair = kernels.pass[Hertz][static_cast<int>(Tangential)][static_cast<int>(Rolling) + Twists];
  pair[0] = &PassOf<Width, Hertz, LawKind<Tangential, Rolling, Twists, false>>::run;
  pair[1] = &PassOf<Width, Hertz, LawKind<Tangential, Rolling, Twists, true>>::run;
}
template <int Width, bool Hertz, TangentialLaw Tangential>
POLARGRAIN_INLINE void list_rolling(SphereKernels& kernels) {
  list_settings<Width, Hertz, Tangential, RollingLaw::off, false>(kernels);
  list_settings<Width, Hertz, Tangential, RollingLaw::epsd2, false>(kernels);
  list_settings<Width, Hertz, Tangential, RollingLaw::li_chu, false>(kernels);
  list_settings<Width, Hertz, Tangential, RollingLaw::li_chu, true>(kernels);
}
template <int Width>
POLARGRAIN_INLINE SphereKernels kernels_of_lanes() {
  SphereKernels kernels{};
  list_rolling<Width, false, TangentialLaw::history>(kernels);
  list_rolling<Width, false, TangentialLaw::li_chu>(kernels);
  list_rolling<Width, true, TangentialLaw::history>(kernels);
  list_rolling<Width, true, TangentialLaw::li_chu>(kernels);
  using Numbers = typename OneGrain<Width>::Numbers;
  kernels.begin_step = &begin_a_step<Numbers>;
  kernels.end_step = &end_a_step<Numbers>;
  return kernels;
}

}  // namespace
}  // namespace polargrain::dem
