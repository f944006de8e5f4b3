// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/stock_laws.hpp"

#include <cmath>
#include <cstdint>

#include "dem/contact/hertz_slope.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

StockLaws::StockLaws(LAMMPS_NS::LAMMPS& lammps) : lammps_(&lammps) {
  // Stock contact models are packed into one number, six bits each: the normal one first, the rolling one fourth.
  auto* const pair =
      lammps.force->pair != nullptr ? dynamic_cast<LAMMPS_NS::PairGran*>(lammps.force->pair) : nullptr;
  constexpr std::int64_t kPlace = 18;
  constexpr std::int64_t kMask = 63;
  if (pair == nullptr) return;
  const std::int64_t normal = pair->hashcode() & kMask;
  if (normal == LIGGGHTS::ContactModels::HERTZ || normal == LIGGGHTS::ContactModels::HERTZ_STIFFNESS)
    slope_ = kHertzSlope;
  if (((pair->hashcode() >> kPlace) & kMask) == LIGGGHTS::ContactModels::ROLLING_EPSD2)
    friction_ = lammps.modify->find_fix_property("coefficientRollingFriction", "property/global",
                                                 "peratomtypepair", 0, 0, "polargrain", false);
}

void StockLaws::complete(std::vector<Contact>& contacts) const {
  if (slope_ != 1.0)
    for (Contact& contact : contacts) contact.normal_stiffness *= slope_;
  if (friction_ == nullptr) return;
  const LAMMPS_NS::Atom& atom = *lammps_->atom;
  for (Contact& contact : contacts) {
    const double first = atom.radius[contact.first];
    const double second = atom.radius[contact.second];
    const double radius = first * second / (first + second);
    contact.rolling_stiffness = contact.tangential_stiffness * radius * radius;
    const double friction =
        friction_->compute_array(atom.type[contact.first] - 1, atom.type[contact.second] - 1);
    // The moment was taken from a difference of torques: a few digits are lost.
    const double normal_force = std::abs(contact.force.dot(contact.branch)) / contact.branch.norm();
    contact.rolling_limit = friction * radius * normal_force;
    contact.rolling_at_limit = contact.moment.norm() >= contact.rolling_limit * (1.0 - 1e-6);
  }
}

}  // namespace polargrain::dem
