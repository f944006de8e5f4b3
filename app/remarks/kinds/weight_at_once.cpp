// SPDX-License-Identifier: GPL-2.0-or-later
// Weight from time zero on ground that has no stress to carry it: step 0 makes it, and movements count from before.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"
#include "app/remarks/weights.hpp"

namespace polargrain::app {
namespace {

template <int dim>
void look_at_weight_at_once(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  if (scene.stress_at_start() == Scene::StressAtStart::run_before) return;  // its weight acts already
  const auto& monitors = scene.the_case().monitors;
  const auto reads =
      std::ranges::find(monitors, coupler::Monitor::Kind::displacement, &coupler::Monitor::kind);
  for (const SceneRegion& region : scene.regions()) {
    if (region.cell != nullptr || region.comes_later || region.elements.empty() || !is_strong(scene, region))
      continue;
    const double weight = weight_at_start(scene, region.name);
    const int node = problem.mesh.elements[static_cast<std::size_t>(region.elements.front())].nodes.front();
    if (weight <= 0.0 ||
        scene.initial_stress<dim>(region, problem.mesh.nodes[static_cast<std::size_t>(node)]).has_value())
      continue;
    remarks.push_back(
        {Rank::doubtful, 1.0,
         scene.place({"body"}).fault(fmt::format(
             "body: {:.4g} kN/m3 act on region '{}' from time zero, and it has no stress then: step 0 takes up all of the "
             "weight at once{}",
             1e-3 * weight, region.name,
             reads == monitors.end()
                 ? std::string()
                 : fmt::format(", and monitor '{}' counts this settlement too", reads->name))),
         "level ground: initial_stress: [{surface: HEIGHT, unit_weight: ..., K0: ...}]; else let the weight grow over "
         "steps, factor: [[0, 0], [1, 1]]"});
    return;
  }
}

}  // namespace

void weight_at_once(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_at_weight_at_once(scene, problem, remarks); });
}

}  // namespace polargrain::app
