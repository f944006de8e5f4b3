// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/grains_in_laboratory.hpp"

#include "dem/box/box_motion.hpp"
#include "dem/cell/averages.hpp"

namespace polargrain::dem {

GrainView grains_in_laboratory(std::vector<GrainView::Grain> grains, std::span<const Contact> contacts,
                               const Eigen::Matrix3d& base, const Eigen::Matrix3d& frame) {
  const Box<3> box{base, frame};
  GrainView view;
  view.box = frame * base;
  view.grains = std::move(grains);
  for (GrainView::Grain& grain : view.grains) {
    grain.position = frame * box.folded(grain.position);
    grain.velocity = frame * grain.velocity;
    grain.spin = frame * grain.spin;
  }
  for (const Contact& contact : contacts) {
    GrainView::Contact& shown = view.contacts.emplace_back();
    shown.first = static_cast<std::size_t>(contact.first);
    shown.second = static_cast<std::size_t>(contact.second);
    shown.branch = frame * contact.branch;
    shown.force = frame * contact.force;
    shown.moment = frame * contact.moment;
    shown.sliding = contact.sliding();
    shown.rolling = contact.rolling_at_limit;
    ++view.grains[shown.first].contacts;
    ++view.grains[shown.second].contacts;
  }
  return view;
}

}  // namespace polargrain::dem
