// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The pass over the contacts of discs for numbers of some lanes. Included by one file for each instruction set. Each lane is one
// contact; forces are summed up in the order of the list, as the plain twin does it (plain_contact_loop.cpp), whose bits
// these are.
#include "dem/discs/disc_contact.hpp"
#include "dem/discs/disc_motion_kernels.hpp"
#include "dem/discs/disc_pass.hpp"

namespace polargrain::dem {
namespace {

template <int Width, NormalLaw Normal, typename Kind>
struct DiscPassOf {
  using Number = Lanes<Width>;
  using Sum = RowOfLane<Width>;
  using Contact = DiscContact<Normal, Kind, Number>;
  static constexpr bool has_spring(int place) {
    if (place == 0) return true;
    if (place == 1) return Kind::tangential == TangentialLaw::history || !Kind::bare;
    return Kind::rolling != RollingLaw::off;
  }
  /// Candidates that are treated before their forces are summed up: the processor then has several of them in hand.
  static constexpr int kStretch = 64;
  /// Force on the first disc, two; minus the moment that it takes; the moment that the second one takes.
  using Answers = double[4][kStretch];
  static constexpr int kMeetings = 6;
  POLARGRAIN_INLINE static const double* row(const Disc* disc) { return &disc->x; }
  POLARGRAIN_INLINE static double* row(DiscForce* force) { return &force->x; }
  /// @param disc the number at which the row of the disc begins. A processor multiplies by such a small power of two on the way.
  POLARGRAIN_INLINE static double* force_at(DiscForce* forces, unsigned disc) {
    constexpr unsigned long kBytes = kForceRow * sizeof(double) / kDiscRow;
    return reinterpret_cast<double*>(reinterpret_cast<char*>(forces) + kBytes * disc);
  }

  POLARGRAIN_INLINE static Number parameter(const DiscPass& pass, int c, double PairParameters::*which) {
    if (!pass.kind) return all<Number>(pass.parameters->*which);
    return of_each_lane<Number>([&pass, c, which](int lane) POLARGRAIN_INLINE_LAMBDA {
      return pass.parameters[pass.kind[c + lane]].*which;
    });
  }

  POLARGRAIN_INLINE static ParametersOf<Number> parameters(const DiscPass& pass, int c) {
    return {parameter(pass, c, &PairParameters::normal),
            parameter(pass, c, &PairParameters::tangential),
            parameter(pass, c, &PairParameters::normal_damping),
            parameter(pass, c, &PairParameters::tangential_damping),
            parameter(pass, c, &PairParameters::friction),
            parameter(pass, c, &PairParameters::rolling_friction),
            parameter(pass, c, &PairParameters::rolling_stiffness),
            parameter(pass, c, &PairParameters::rolling_damping),
            parameter(pass, c, &PairParameters::rolling_force_friction),
            parameter(pass, c, &PairParameters::rolling_force_stiffness),
            parameter(pass, c, &PairParameters::rolling_force_damping)};
  }

  /// Where as many candidates as there are lanes lie and how they move. Roots and quotients take long: nothing waits for
  /// them before the next candidates are under way.
  POLARGRAIN_INLINE static void approach(const DiscPass& pass, int c, double* const (&out)[kMeetings]) {
    const double* const rows = row(pass.discs);
    const double* const images = &pass.images->x;
    // A contact asks for differences: taken row by row, before the rows become columns.
    Number apart[4];
    columns_of(
        [&]<typename Part>(int lane, int k, Part) POLARGRAIN_INLINE_LAMBDA {
          return load<Part>(rows + pass.first[c + lane] + k) - load<Part>(rows + pass.second[c + lane] + k) -
                 load<Part>(images + pass.image[c + lane] + k);
        },
        apart);
    DiscPair<Number> pair;
    pair.dx = apart[0];
    pair.dy = apart[1];
    pair.vx = apart[2];
    pair.vy = apart[3];
    pair.measure();
    const Number made[] = {pair.dx, pair.dy, pair.vx, pair.vy, pair.distance, pair.over_distance};
    for (int k = 0; k < kMeetings; ++k) store(out[k], made[k]);
  }

  /// One number of each disc.
  POLARGRAIN_INLINE static Number gathered(const double* of_first_disc, const unsigned* rows) {
    return of_each_lane<Number>([of_first_disc, rows](int lane)
                                    POLARGRAIN_INLINE_LAMBDA { return of_first_disc[rows[lane]]; });
  }

  POLARGRAIN_INLINE static DiscPair<Number> meet(const DiscPass& pass, int c,
                                                 const double* const (&from)[kMeetings]) {
    DiscPair<Number> pair;
    pair.dx = load<Number>(from[0]);
    pair.dy = load<Number>(from[1]);
    pair.vx = load<Number>(from[2]);
    pair.vy = load<Number>(from[3]);
    pair.distance = load<Number>(from[4]);
    pair.over_distance = load<Number>(from[5]);
    pair.spin_first = gathered(&pass.discs->spin, pass.first + c);
    pair.spin_second = gathered(&pass.discs->spin, pass.second + c);
    GrainPair<Number>& grains = pair.grains;
    grains.radius_first = load<Number>(pass.radius_first + c);
    grains.radius_second = load<Number>(pass.radius_second + c);
    grains.inverse_mass_first = grains.inverse_mass_second = Number{};
    grains.inverse_inertia_first = grains.inverse_inertia_second = Number{};
    // Dashpots alone ask for masses.
    if (!Kind::bare && pass.settings.has_dashpots()) {
      grains.inverse_mass_first = gathered(&pass.discs->inverse_mass, pass.first + c);
      grains.inverse_mass_second = gathered(&pass.discs->inverse_mass, pass.second + c);
      grains.inverse_inertia_first = gathered(&pass.discs->inverse_inertia, pass.first + c);
      grains.inverse_inertia_second = gathered(&pass.discs->inverse_inertia, pass.second + c);
    }
    grains.harmonic = load<Number>(pass.harmonic + c);
    return pair;
  }

  /// As many candidates as there are lanes. @param out where their answers go
  POLARGRAIN_INLINE static void treat(const DiscPass& pass, int c, const DiscPair<Number>& pair,
                                      double* const (&out)[4]) {
    const auto touching = pair.touches();
    const ParametersOf<Number> p = parameters(pass, c);
    Number springs[kDiscSprings]{};
    for (int k = 0; k < kDiscSprings; ++k)
      if (has_spring(k)) springs[k] = load<Number>(pass.springs[k] + c);
    ContactLaw<Kind, Contact> law(pass.settings, pass.step, pass.advance, pair, p, pass.settings, pass.bend_x,
                                  pass.bend_y, &springs[0]);
    const LawAnswer<Contact> made = law();
    const Contact& contact = law.contact;
    // Discs that have parted forget their springs.
    if (pass.advance)
      for (int k = 0; k < kDiscSprings; ++k)
        if (has_spring(k)) store(pass.springs[k] + c, select(touching, springs[k], Number{}));

    Number turn_first = contact.arm_first * made.resistance;
    Number turn_second = contact.arm_second * made.resistance;
    if constexpr (Kind::rolling != RollingLaw::off) {
      turn_first = turn_first - made.moment;
      turn_second = turn_second + made.moment;
    }
    store(out[0], select(touching, made.normal * contact.nx + made.resistance * contact.ny, Number{}));
    store(out[1], select(touching, made.normal * contact.ny - made.resistance * contact.nx, Number{}));
    store(out[2], select(touching, turn_first, Number{}));
    store(out[3], select(touching, -turn_second, Number{}));
    if (!pass.records) return;
    const auto put = [&pass, c](int column, Number value) POLARGRAIN_INLINE_LAMBDA {
      store(pass.records + static_cast<long>(column) * pass.candidates + c, value);
    };
    put(DiscRecord::touches, select(touching, all<Number>(1.0), Number{}));
    put(DiscRecord::delta, pair.dx);
    put(DiscRecord::delta + 1, pair.dy);
    put(DiscRecord::force, load<Number>(out[0]));
    put(DiscRecord::force + 1, load<Number>(out[1]));
    put(DiscRecord::moment, made.moment);
    put(DiscRecord::stiffnesses, made.stiff.normal);
    put(DiscRecord::stiffnesses + 1, made.stiff.tangential);
    put(DiscRecord::dashpots, made.stiff.normal_dashpot);
    put(DiscRecord::dashpots + 1, made.stiff.tangential_dashpot);
    put(DiscRecord::arms, contact.arm_first);
    put(DiscRecord::arms + 1, contact.arm_second);
    put(DiscRecord::rolling, made.rolling_stiffness);
    put(DiscRecord::rolling_limit, made.rolling_limit);
    put(DiscRecord::is_rolling, made.is_rolling);
  }

  /// Adds the answers of as many candidates as there are lanes to the sums of their rows and to the second discs.
  /// @param begin of the stretch; @param k candidates of the stretch before these
  POLARGRAIN_INLINE static void sum_up(const DiscPass& pass, int begin, int k, const Answers& answers,
                                       Sum& sum) {
    Sum rows[Width];
    rows_of({load<Number>(answers[0] + k), load<Number>(answers[1] + k), load<Number>(answers[2] + k)},
            load<Number>(answers[3] + k), rows);
    for (int lane = 0; lane < Width; ++lane) {
      const int c = begin + k + lane;
      sum = rows[lane].plus_kept(sum, pass.continues[c]);
      sum.put(force_at(pass.row_sums, pass.first[c]));
      rows[lane].with_fourth_as_third().take_from(force_at(pass.forces, pass.second[c]));
    }
  }

  static void run(const DiscPass& given) {
    const DiscPass pass = given;  // a copy that no store can alias
    alignas(64) Answers answers;
    alignas(64) double meetings[kMeetings][kStretch];
    Sum sum;
    int count = 0;
    for (int begin = 0; begin < pass.candidates; begin += kStretch) {
      count = pass.candidates - begin < kStretch ? pass.candidates - begin : kStretch;
      // Each sum waits for the one before, each quotient for the divider: side by side they cost one of the two.
      const int summed = begin > 0 ? kStretch : 0;
      for (int k = 0; k < kStretch; k += Width) {
        if (k < summed) sum_up(pass, begin - kStretch, k, answers, sum);
        if (k < count)
          approach(pass, begin + k,
                   {meetings[0] + k, meetings[1] + k, meetings[2] + k, meetings[3] + k, meetings[4] + k,
                    meetings[5] + k});
      }
      for (int k = 0; k < count; k += Width) {
        const DiscPair<Number> pair = meet(pass, begin + k,
                                           {meetings[0] + k, meetings[1] + k, meetings[2] + k,
                                            meetings[3] + k, meetings[4] + k, meetings[5] + k});
        double* const out[] = {answers[0] + k, answers[1] + k, answers[2] + k, answers[3] + k};
        treat(pass, begin + k, pair, out);
      }
    }
    for (int k = 0; k < count; k += Width) sum_up(pass, pass.candidates - count, k, answers, sum);
    for (int k = 0; k < pass.count; ++k) {
      const double* const from = row(pass.row_sums + k);
      double* const to = row(pass.forces + k);
      for (int axis = 0; axis < 4; ++axis) to[axis] += from[axis];
    }
  }
};

template <int Width, NormalLaw Normal, TangentialLaw Tangential, RollingLaw Rolling>
void list_settings(DiscKernels& kernels) {
  auto& pair =
      kernels.pass[static_cast<int>(Normal)][static_cast<int>(Tangential)][static_cast<int>(Rolling)];
  pair[0] = &DiscPassOf<Width, Normal, LawKind<Tangential, Rolling, false, false>>::run;
  pair[1] = &DiscPassOf<Width, Normal, LawKind<Tangential, Rolling, false, true>>::run;
}

template <int Width, NormalLaw Normal, TangentialLaw Tangential>
void list_rolling(DiscKernels& kernels) {
  list_settings<Width, Normal, Tangential, RollingLaw::off>(kernels);
  list_settings<Width, Normal, Tangential, RollingLaw::epsd2>(kernels);
  list_settings<Width, Normal, Tangential, RollingLaw::li_chu>(kernels);
}

template <int Width, NormalLaw Normal>
void list_tangential(DiscKernels& kernels) {
  list_rolling<Width, Normal, TangentialLaw::history>(kernels);
  list_rolling<Width, Normal, TangentialLaw::li_chu>(kernels);
}

template <int Width>
DiscKernels disc_kernels_of_lanes() {
  DiscKernels kernels{};
  list_tangential<Width, NormalLaw::hooke_radii>(kernels);
  list_tangential<Width, NormalLaw::hooke_stiffness>(kernels);
  list_tangential<Width, NormalLaw::hertz>(kernels);
  kernels.begin_step = &begin_disc_step<Lanes<Width>>;
  kernels.end_step = &end_disc_step<Lanes<Width>>;
  return kernels;
}

}  // namespace
}  // namespace polargrain::dem
