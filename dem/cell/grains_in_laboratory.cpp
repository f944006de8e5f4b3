// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/grains_in_laboratory.hpp"

#include "dem/spheres/space_box.hpp"
#include "dem/spheres/space_contact.hpp"

namespace polargrain::dem {

GrainView grains_in_laboratory(std::vector<GrainView::Grain> grains, std::span<const Contact> contacts,
                               const Eigen::Matrix3d& base, const Eigen::Matrix3d& frame) {
  const SpaceBox box{base, frame};
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
    shown.branch = frame * branch_of(contact);
    shown.force = frame * force_of(contact);
    shown.moment = frame * moment_of(contact);
    shown.sliding = slides_in_space(contact);
    shown.rolling = contact.rolling_at_limit;
    ++view.grains[shown.first].contacts;
    ++view.grains[shown.second].contacts;
  }
  return view;
}

}  // namespace polargrain::dem
