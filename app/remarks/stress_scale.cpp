// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/stress_scale.hpp"

#include <algorithm>

#include "app/remarks/lengths.hpp"

namespace polargrain::app {
namespace {

/// Largest normal stress at the start of a region of a law, at its first node; 0 where nothing gives one.
template <int dim>
double stress_at_start(const Scene& scene, const SceneRegion& region, const fem::Problem<dim>& problem) {
  const int node = problem.mesh.elements[static_cast<std::size_t>(region.elements.front())].nodes.front();
  const auto stress = scene.initial_stress<dim>(region, problem.mesh.nodes[static_cast<std::size_t>(node)]);
  double largest = 0.0;
  for (int i = 0; stress && i < 3; ++i)
    largest = std::max(largest, std::abs((*stress)(Cosserat<dim>::stress_place(i, i))));
  return largest;
}

}  // namespace

double stress_scale(const Scene& scene) {
  return scene.with_problem([&]<int dim>(const fem::Problem<dim>& problem) {
    double scale = 0.0;
    for (const fem::BoundaryLoad<dim>& load : problem.boundary_loads) {
      scale = std::max(scale, load.pressure.largest_magnitude());
      for (const fem::TimeTable& along : load.traction) scale = std::max(scale, along.largest_magnitude());
    }
    for (const fem::BodyLoad<dim>& load : problem.body_loads) {
      const double height = load.region.empty()
                                ? scene.body().height()
                                : height_of(problem.mesh, problem.mesh.regions.at(load.region));
      scale = std::max(
          scale, load.density(problem.mesh.nodes.front()).norm() * load.factor.largest_magnitude() * height);
    }
    for (const SceneRegion& region : scene.regions())
      if (region.cell == nullptr && !region.elements.empty())
        scale = std::max(scale, stress_at_start(scene, region, problem));
    return scale;
  });
}

}  // namespace polargrain::app
