// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/stress_scale.hpp"

#include <algorithm>

namespace polargrain::app {

double stress_scale(const Scene& scene) {
  double scale = 0.0;
  for (const fem::BoundaryLoad<2>& load : scene.problem().boundary_loads)
    for (const fem::TimeTable* const table : {&load.pressure, &load.traction[0], &load.traction[1]})
      scale = std::max(scale, table->largest_magnitude());
  for (const fem::BodyLoad<2>& load : scene.problem().body_loads)
    scale = std::max(scale, load.density(scene.body().least).norm() * load.factor.largest_magnitude() *
                                scene.body().size().y());
  for (const SceneRegion& region : scene.regions())
    if (region.cell == nullptr && !region.elements.empty()) {
      const int node = scene.mesh().elements[static_cast<std::size_t>(region.elements.front())].nodes.front();
      if (const auto stress =
              scene.initial_stress(region, scene.mesh().nodes[static_cast<std::size_t>(node)]))
        scale = std::max(scale, stress->head<3>().cwiseAbs().maxCoeff());
    }
  return scale;
}

}  // namespace polargrain::app
