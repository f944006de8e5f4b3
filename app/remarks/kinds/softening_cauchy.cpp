// SPDX-License-Identifier: GPL-2.0-or-later
// A material that softens in a continuum without a length. Slips that are spread have one.
#include <fmt/format.h>

#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"

namespace polargrain::app {
void softening_cauchy(const Scene& scene, Remarks& remarks) {
  if (!scene.is_classical() || scene.the_case().spread > 0.0) return;
  for (const SceneRegion& region : scene.regions()) {
    // A single element has one deformation, whatever its size.
    if (!softens(scene, region) || region.elements.size() < 2) continue;
    remarks.push_back(
        {Rank::doubtful, 2.0,
         scene.place({"continuum"})
             .fault(fmt::format(
                 "continuum: 'cauchy' has no length, and material '{}' softens behind its peak: bands become one element "
                 "wide, and the curve falls the faster the finer the mesh ({} elements here)",
                 region.material, scene.body().elements.size())),
         "set 'continuum: cosserat' with Gc and lc, or do not read anything behind the peak"});
    return;
  }
}

}  // namespace polargrain::app
