// SPDX-License-Identifier: GPL-2.0-or-later
// The loop over the contacts of discs as the equations have it (docs/theory/grains.md, C.1 and D).
#include "dem/discs/plain_contact_loop.hpp"

#include "dem/discs/laws.hpp"

namespace polargrain::dem {

namespace {

NormalAnswer<double> normal_answer(const DiscCombination& combination, const PairParameters& p,
                                   const Touch<double>& touch) {
  switch (combination.normal) {
    case NormalLaw::hooke_radii:
      return normal_law<NormalLaw::hooke_radii>(p, combination.settings, touch);
    case NormalLaw::hooke_stiffness:
      return normal_law<NormalLaw::hooke_stiffness>(p, combination.settings, touch);
    case NormalLaw::hertz:
      return normal_law<NormalLaw::hertz>(p, combination.settings, touch);
  }
  return {};
}

RollingAnswer<double> rolling_answer(const DiscCombination& combination, const PairParameters& p,
                                     const Touch<double>& touch, const NormalAnswer<double>& normal,
                                     const PlainContactLoop::Scene& scene, double* springs) {
  const LawSettings& on = combination.settings;
  switch (combination.rolling) {
    case RollingLaw::off:
      return {};
    case RollingLaw::epsd2:
      return rolling_law<RollingLaw::epsd2>(p, on, touch, normal, scene.step, scene.advance, springs);
    case RollingLaw::li_chu:
      return rolling_law<RollingLaw::li_chu>(p, on, touch, normal, scene.step, scene.advance, springs);
  }
  return {};
}

DiscPair<double> meet(const PlainContactLoop::Scene& scene, const CandidateList& list, int c) {
  const Disc& a = scene.discs[list.first[c]];
  const Disc& b = scene.discs[list.second[c]];
  const MovingImage& image = scene.images[list.image[c]];
  DiscPair<double> pair;
  pair.dx = a.x - b.x - image.x;
  pair.dy = a.y - b.y - image.y;
  pair.vx = a.vx - b.vx - image.vx;
  pair.vy = a.vy - b.vy - image.vy;
  pair.spin_first = a.spin;
  pair.spin_second = b.spin;
  pair.radius_first = a.radius;
  pair.radius_second = b.radius;
  pair.harmonic = list.harmonic[c];
  pair.inverse_mass_first = a.inverse_mass;
  pair.inverse_mass_second = b.inverse_mass;
  pair.inverse_inertia_first = a.inverse_inertia;
  pair.inverse_inertia_second = b.inverse_inertia;
  return pair;
}

}  // namespace

void PlainContactLoop::add_forces(const Scene& scene, CandidateList& list,
                                  std::span<DiscForce> forces) const {
  for (std::size_t i = 0; i < scene.discs.size(); ++i) {
    DiscForce sum;
    for (std::int32_t c = list.rows[i]; c < list.rows[i + 1]; ++c) {
      DiscPair<double> pair = meet(scene, list, c);
      if (!pair.touches()) {
        if (scene.records) scene.records[c] = 0.0;
        if (scene.advance)
          for (LineVector<double>& values : list.springs) values[c] = 0.0;
        continue;
      }
      pair.measure();
      const Touch<double> touch = touch_of(pair, scene.curvature_rate.x(), scene.curvature_rate.y());
      const PairParameters& p = combination_.pairs[list.kind[c]];
      const NormalAnswer<double> normal = normal_answer(combination_, p, touch);
      double springs[kDiscSprings] = {list.springs[0][c], list.springs[1][c], list.springs[2][c]};
      const double tangential =
          combination_.tangential == TangentialLaw::history
              ? tangential_law<TangentialLaw::history>(p, combination_.settings, touch, normal, scene.step,
                                                       scene.advance, springs)
              : tangential_law<TangentialLaw::li_chu>(p, combination_.settings, touch, normal, scene.step,
                                                      scene.advance, springs);
      const RollingAnswer<double> rolling = rolling_answer(combination_, p, touch, normal, scene, springs);
      for (int k = 0; k < kDiscSprings; ++k) list.springs[k][c] = springs[k];

      const double fx = normal.force * touch.nx - tangential * touch.ny;  // on the first
      const double fy = normal.force * touch.ny + tangential * touch.nx;
      sum.x += fx;
      sum.y += fy;
      sum.torque -= touch.arm_first * tangential + rolling.moment;
      DiscForce& other = forces[list.second[c]];
      other.x -= fx;
      other.y -= fy;
      other.torque -= touch.arm_second * tangential - rolling.moment;

      if (!scene.records) continue;
      const double made[] = {1.0,
                             pair.dx,
                             pair.dy,
                             fx,
                             fy,
                             rolling.moment,
                             normal.kn,
                             normal.kt,
                             normal.normal_dashpot,
                             normal.tangential_dashpot,
                             touch.arm_first,
                             touch.arm_second,
                             rolling.stiffness,
                             rolling.limit,
                             rolling.at_limit};
      for (int column = 0; column < DiscRecord::columns; ++column)
        scene.records[static_cast<std::size_t>(column) * list.second.size() + c] = made[column];
    }
    forces[i].x += sum.x;
    forces[i].y += sum.y;
    forces[i].torque += sum.torque;
  }
}

}  // namespace polargrain::dem
