// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "app/remarks/scene.hpp"

namespace polargrain::app {

/// Weight of a region, downwards positive, N/m^3: of all items that name it or the whole body. @param factor of each, of its table
template <int dim, class Factor>
double weight_of(const fem::Problem<dim>& problem, const std::string& region, Factor factor) {
  double weight = 0.0;
  for (const fem::BodyLoad<dim>& load : problem.body_loads)
    if (load.region.empty() || load.region == region)
      weight -= factor(load.factor) * load.density(problem.mesh.nodes.front())(dim - 1);
  return weight;
}

/// At time zero.
inline double weight_at_start(const Scene& scene, const std::string& region) {
  return scene.with_problem([&](const auto& problem) {
    return weight_of(problem, region, [](const fem::TimeTable& factor) { return factor.at(0.0); });
  });
}

/// At its full value, whenever that is.
template <int dim>
double full_weight(const fem::Problem<dim>& problem, const std::string& region) {
  return weight_of(problem, region, [](const fem::TimeTable& factor) { return factor.largest_magnitude(); });
}

}  // namespace polargrain::app
