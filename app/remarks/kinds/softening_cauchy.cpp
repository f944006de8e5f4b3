// SPDX-License-Identifier: GPL-2.0-or-later
// A material that softens in a continuum without a length.
#include <fmt/format.h>

#include <algorithm>

#include "app/remarks/kinds.hpp"

namespace polargrain::app {
namespace {

/// Whether the last of a list of values, or of [plastic shear, value], is below the largest.
bool falls(const coupler::Entry* entry, coupler::Dimension dimension) {
  if (entry == nullptr || entry->kind != coupler::Entry::Kind::sequence) return false;
  double largest = 0.0;
  double last = 0.0;
  for (const coupler::Entry& item : entry->items) {
    const coupler::Entry& value = item.items.size() == 2 ? item.items[1] : item;
    last = coupler::parse_quantity(value.text, dimension).value_or(0.0);
    largest = std::max(largest, last);
  }
  return last < largest;
}

}  // namespace

void softening_cauchy(const Scene& scene, Remarks& remarks) {
  if (scene.problem().continuum != fem::Continuum::cauchy) return;
  for (const SceneRegion& region : scene.regions()) {
    const bool softens =
        falls(scene.find({"materials", region.material, "friction_angle"}), coupler::Dimension::angle) ||
        falls(scene.find({"materials", region.material, "cohesion"}), coupler::Dimension::pressure);
    // A single element has one deformation, whatever its size.
    if ((!softens && region.cell == nullptr) || region.elements.size() < 2) continue;
    remarks.push_back(
        {Rank::doubtful, 2.0,
         scene.place({"continuum"})
             .fault(fmt::format(
                 "continuum: 'cauchy' has no length, and material '{}' softens behind its peak: bands become one element "
                 "wide, and the curve falls the faster the finer the mesh ({} elements here)",
                 region.material, scene.mesh().elements.size())),
         "set 'continuum: cosserat' with Gc and lc, or do not read anything behind the peak"});
    return;
  }
}

}  // namespace polargrain::app
