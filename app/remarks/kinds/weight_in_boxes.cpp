// SPDX-License-Identifier: GPL-2.0-or-later
// The weight of ground against the one pressure that all its boxes of grains are packed under.
#include <fmt/format.h>

#include "app/remarks/given_stress.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"

namespace polargrain::app {
namespace {

constexpr double kSlackOfBoxes = 0.1;  // of the pressure of the packing
constexpr double kFarOfBoxes = 0.5;

template <int dim>
void look_at_boxes(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  for (const SceneRegion& region : scene.regions()) {
    const double pressure = Scene::pressure_of(region);
    if (region.cell == nullptr || region.comes_later || pressure <= 0.0 ||
        has_given_stress(scene, region.name))
      continue;
    double weight = 0.0;
    for (const fem::BodyLoad<dim>& load : problem.body_loads)
      if (load.region.empty() || load.region == region.name)
        weight += load.factor.at(0.0) * load.density(problem.mesh.nodes.front()).norm();
    const double height = height_of(problem.mesh, region.elements);
    const double share = weight * height / pressure;
    if (share <= kSlackOfBoxes) continue;
    remarks.push_back(
        {share > kFarOfBoxes ? Rank::wrong : Rank::doubtful, 1.0 + share,
         scene.place({"body"}).fault(fmt::format(
             "body: the weight of {:.3g} m of region '{}' adds {:.4g} kPa from top to bottom at time zero, and all its boxes of "
             "grains are packed under {:.4g} kPa",
             height, region.name, 1e-3 * weight * height, 1e-3 * pressure)),
         "level ground: initial_stress: [{surface: HEIGHT, unit_weight: ..., K0: measured}] leads the boxes to their depths; "
         "else let the weight grow over steps: factor: [[0, 0], [1, 1]]"});
  }
}

}  // namespace

void weight_in_boxes(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_at_boxes(scene, problem, remarks); });
}

}  // namespace polargrain::app
