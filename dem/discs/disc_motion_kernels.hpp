// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Velocity Verlet in a moving box for discs, with numbers of some lanes. Included by one file for each instruction set.
#include "dem/discs/disc_pass.hpp"
#include "dem/lanes/vectors.hpp"

namespace polargrain::dem {
namespace {

/// As many discs as there are lanes.
template <typename Number>
struct DiscsOf {
  Number x, y, vx, vy, spin, radius, inverse_mass, inverse_inertia;
  Number fx, fy, torque;
  Number ax, ay, angular, turned;

  POLARGRAIN_INLINE void end_step(const DiscMotionPass& pass) {
    const double* const flow = pass.gradient;
    const double rate = pass.damping_rate;
    const double half = 0.5 * pass.step;
    ax = fx * inverse_mass - rate * (vx - (flow[0] * x + flow[1] * y));
    ay = fy * inverse_mass - rate * (vy - (flow[2] * x + flow[3] * y));
    angular = torque * inverse_inertia - rate * (spin - pass.spin);
    vx = vx + half * ax;
    vy = vy + half * ay;
    spin = spin + half * angular;
  }

  /// Velocities that the box adds, half a kick, drift. @returns square of the speed against the affine flow
  POLARGRAIN_INLINE Number begin_step(const DiscMotionPass& pass) {
    const double step = pass.step;
    const double half = 0.5 * pass.step;
    vx = vx + (pass.change[0] * x + pass.change[1] * y);
    vy = vy + (pass.change[2] * x + pass.change[3] * y);
    spin = spin + pass.change_of_spin;
    vx = vx + half * ax;
    vy = vy + half * ay;
    spin = spin + half * angular;
    const Number ux = vx - (pass.flow[0] * x + pass.flow[1] * y);
    const Number uy = vy - (pass.flow[2] * x + pass.flow[3] * y);
    x = x + step * vx;
    y = y + step * vy;
    turned = turned + (step * spin + pass.turn);
    return ux * ux + uy * uy;
  }
};

POLARGRAIN_INLINE DiscsOf<double> discs_at(const DiscMotionPass& pass, int k, double) {
  const Disc& disc = pass.discs[k];
  const DiscForce& force = pass.forces[k];
  const DiscMotion& motion = pass.motions[k];
  return {disc.x,    disc.y,         disc.vx,           disc.vy,
          disc.spin, disc.radius,    disc.inverse_mass, disc.inverse_inertia,
          force.x,   force.y,        force.torque,      motion.ax,
          motion.ay, motion.angular, motion.turned};
}
POLARGRAIN_INLINE void put(const DiscMotionPass& pass, int k, const DiscsOf<double>& made) {
  Disc& disc = pass.discs[k];
  disc.x = made.x;
  disc.y = made.y;
  disc.vx = made.vx;
  disc.vy = made.vy;
  disc.spin = made.spin;
  pass.motions[k] = {made.ax, made.ay, made.angular, made.turned};
}

inline constexpr int kInOrder[] = {0, 1, 2, 3, 4, 5, 6, 7};

template <typename Number>
POLARGRAIN_INLINE DiscsOf<Number> discs_at(const DiscMotionPass& pass, int k, Number) {
  constexpr int kStride = sizeof(Disc) / sizeof(double);
  Number place[4], rest[4], force[4], motion[4];
  load_columns<kStride>(&pass.discs[k].x, kInOrder, place);
  load_columns<kStride>(&pass.discs[k].spin, kInOrder, rest);
  load_columns<4>(&pass.forces[k].x, kInOrder, force);
  load_columns<4>(&pass.motions[k].ax, kInOrder, motion);
  return {place[0], place[1], place[2], place[3],  rest[0],   rest[1],   rest[2],  rest[3],
          force[0], force[1], force[2], motion[0], motion[1], motion[2], motion[3]};
}
template <typename Number>
POLARGRAIN_INLINE void put(const DiscMotionPass& pass, int k, const DiscsOf<Number>& made) {
  RowOfLane<kWidth<Number>> places[kWidth<Number>], rests[kWidth<Number>], motions[kWidth<Number>];
  rows_of({made.x, made.y, made.vx}, made.vy, places);
  rows_of({made.spin, made.radius, made.inverse_mass}, made.inverse_inertia, rests);
  rows_of({made.ax, made.ay, made.angular}, made.turned, motions);
  for (int lane = 0; lane < kWidth<Number>; ++lane) {
    places[lane].put(&pass.discs[k + lane].x);
    rests[lane].put(&pass.discs[k + lane].spin);
    motions[lane].put(&pass.motions[k + lane].ax);
  }
}

template <bool Ends, typename Number>
POLARGRAIN_INLINE Number begin_discs(const DiscMotionPass& pass, int k) {
  DiscsOf<Number> discs = discs_at(pass, k, Number{});
  if constexpr (Ends) discs.end_step(pass);
  const Number square = discs.begin_step(pass);
  put(pass, k, discs);
  for (int lane = 0; lane < kWidth<Number>; ++lane) pass.forces[k + lane] = DiscForce{};
  return square;
}

template <typename Number, bool Ends>
double begin_each_disc(const DiscMotionPass& given) {
  const DiscMotionPass pass = given;  // a copy that no store can alias
  Number fastest{};
  int k = 0;
  for (; k + kWidth<Number> <= pass.count; k += kWidth<Number>)
    fastest = greater(begin_discs<Ends, Number>(pass, k), fastest);
  double largest = 0.0;
  for (int lane = 0; lane < kWidth<Number>; ++lane) largest = greater(fastest[lane] + 0.0, largest);
  for (; k < pass.count; ++k) largest = greater(begin_discs<Ends, double>(pass, k), largest);
  return largest;
}

template <typename Number>
double begin_disc_step(const DiscMotionPass& pass, bool ends) {
  return ends ? begin_each_disc<Number, true>(pass) : begin_each_disc<Number, false>(pass);
}

template <typename Number>
POLARGRAIN_INLINE void end_discs(const DiscMotionPass& pass, int k) {
  DiscsOf<Number> discs = discs_at(pass, k, Number{});
  discs.end_step(pass);
  put(pass, k, discs);
}

template <typename Number>
void end_disc_step(const DiscMotionPass& given) {
  const DiscMotionPass pass = given;
  int k = 0;
  for (; k + kWidth<Number> <= pass.count; k += kWidth<Number>) end_discs<Number>(pass, k);
  for (; k < pass.count; ++k) end_discs<double>(pass, k);
}

}  // namespace
}  // namespace polargrain::dem
