// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "app/remarks/scene.hpp"

namespace polargrain::app {

/// Weight of a region at time zero, downwards positive, N/m^3: of all items that name it or the whole body.
inline double weight_at_start(const Scene& scene, const std::string& region) {
  return scene.with_problem([&]<int dim>(const fem::Problem<dim>& problem) {
    double weight = 0.0;
    for (const fem::BodyLoad<dim>& load : problem.body_loads)
      if (load.region.empty() || load.region == region)
        weight -= load.factor.at(0.0) * load.density(problem.mesh.nodes.front())(dim - 1);
    return weight;
  });
}

}  // namespace polargrain::app
