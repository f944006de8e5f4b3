// SPDX-License-Identifier: GPL-2.0-or-later
// The weight of ground against the one pressure that all its boxes of grains are packed under.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/given_stress.hpp"
#include "app/remarks/kinds.hpp"

namespace polargrain::app {
namespace {

constexpr double kSlackOfBoxes = 0.1;  // of the pressure of the packing
constexpr double kFarOfBoxes = 0.5;

double height_of(const Scene& scene, const SceneRegion& region) {
  double least = 1e300;
  double largest = -1e300;
  for (const int element : region.elements)
    for (const int node : scene.mesh().elements[static_cast<std::size_t>(element)].nodes) {
      least = std::min(least, scene.mesh().nodes[static_cast<std::size_t>(node)].y());
      largest = std::max(largest, scene.mesh().nodes[static_cast<std::size_t>(node)].y());
    }
  return largest - least;
}

}  // namespace

void weight_in_boxes(const Scene& scene, Remarks& remarks) {
  for (const SceneRegion& region : scene.regions()) {
    const double pressure = Scene::pressure_of(region);
    if (region.cell == nullptr || region.comes_later || pressure <= 0.0 ||
        has_given_stress(scene, region.name))
      continue;
    double weight = 0.0;
    for (const fem::BodyLoad<2>& load : scene.problem().body_loads)
      if (load.region.empty() || load.region == region.name)
        weight += load.factor.at(0.0) * load.density(scene.body().least).norm();
    const double height = height_of(scene, region);
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

}  // namespace polargrain::app
