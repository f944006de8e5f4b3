// SPDX-License-Identifier: GPL-2.0-or-later
// The loop over the contacts of discs as the equations have it (docs/theory/grains.md, C.1 and D).
#include "dem/discs/plain_contact_loop.hpp"

#include "dem/discs/disc_contact.hpp"

namespace polargrain::dem {

namespace {

/// The law of a contact on numbers of one lane.
struct Answer {
  double force_x, force_y;  ///< on the first, N
  double turn_first, turn_second;
  double moment;
  Stiffnesses<double> stiff;
  double arm_first, arm_second, rolling_stiffness, rolling_limit, is_rolling;
};

using Scene = PlainContactLoop::Scene;

template <NormalLaw Normal, TangentialLaw Tangential, RollingLaw Rolling>
Answer answer_of(const Scene& scene, const LawSettings& on, const PairParameters& p,
                 const DiscPair<double>& pair, double* springs) {
  using Kind = LawKind<Tangential, Rolling, false, false>;
  using Contact = DiscContact<Normal, Kind, double>;
  ContactLaw<Kind, Contact> law(on, scene.step, scene.advance, pair, p, on, scene.curvature_rate.x(),
                                scene.curvature_rate.y(), springs);
  const LawAnswer<Contact> made = law();
  const Contact& contact = law.contact;
  return {made.normal * contact.nx + made.resistance * contact.ny,
          made.normal * contact.ny - made.resistance * contact.nx,
          contact.arm_first * made.resistance - made.moment,
          contact.arm_second * made.resistance + made.moment,
          made.moment,
          made.stiff,
          contact.arm_first,
          contact.arm_second,
          made.rolling_stiffness,
          made.rolling_limit,
          made.is_rolling};
}

using LawOfContact = Answer (*)(const Scene&, const LawSettings&, const PairParameters&,
                                const DiscPair<double>&, double*);

template <NormalLaw Normal, TangentialLaw Tangential>
LawOfContact law_with(RollingLaw rolling) {
  switch (rolling) {
    case RollingLaw::off:
      return &answer_of<Normal, Tangential, RollingLaw::off>;
    case RollingLaw::epsd2:
      return &answer_of<Normal, Tangential, RollingLaw::epsd2>;
    case RollingLaw::li_chu:
      return &answer_of<Normal, Tangential, RollingLaw::li_chu>;
  }
  return nullptr;
}

template <NormalLaw Normal>
LawOfContact law_with(const LawCombination& laws) {
  return laws.tangential == TangentialLaw::history ? law_with<Normal, TangentialLaw::history>(laws.rolling)
                                                   : law_with<Normal, TangentialLaw::li_chu>(laws.rolling);
}

LawOfContact law_of(const LawCombination& laws) {
  switch (laws.normal) {
    case NormalLaw::hooke_radii:
      return law_with<NormalLaw::hooke_radii>(laws);
    case NormalLaw::hooke_stiffness:
      return law_with<NormalLaw::hooke_stiffness>(laws);
    case NormalLaw::hertz:
      return law_with<NormalLaw::hertz>(laws);
  }
  return nullptr;
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
  pair.grains = {a.radius,       b.radius,          list.harmonic[c], a.inverse_mass,
                 b.inverse_mass, a.inverse_inertia, b.inverse_inertia};
  return pair;
}

}  // namespace

void PlainContactLoop::add_forces(const Scene& scene, CandidateList& list,
                                  std::span<DiscForce> forces) const {
  const LawOfContact law = law_of(combination_);
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
      double springs[kDiscSprings] = {list.springs[0][c], list.springs[1][c], list.springs[2][c]};
      const Answer made = law(scene, combination_.settings, combination_.pairs[list.kind[c]], pair, springs);
      if (scene.advance)
        for (int k = 0; k < kDiscSprings; ++k) list.springs[k][c] = springs[k];
      sum.x += made.force_x;
      sum.y += made.force_y;
      sum.torque += made.turn_first;
      DiscForce& other = forces[list.second[c]];
      other.x -= made.force_x;
      other.y -= made.force_y;
      other.torque += made.turn_second;

      if (!scene.records) continue;
      const double record[] = {1.0,
                               pair.dx,
                               pair.dy,
                               made.force_x,
                               made.force_y,
                               made.moment,
                               made.stiff.normal,
                               made.stiff.tangential,
                               made.stiff.normal_dashpot,
                               made.stiff.tangential_dashpot,
                               made.arm_first,
                               made.arm_second,
                               made.rolling_stiffness,
                               made.rolling_limit,
                               made.is_rolling};
      for (int column = 0; column < DiscRecord::columns; ++column)
        scene.records[static_cast<std::size_t>(column) * list.second.size() + c] = record[column];
    }
    forces[i].x += sum.x;
    forces[i].y += sum.y;
    forces[i].torque += sum.torque;
  }
}

}  // namespace polargrain::dem
