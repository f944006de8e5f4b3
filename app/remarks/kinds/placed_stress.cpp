// SPDX-License-Identifier: GPL-2.0-or-later
// A region that a stage places brings the stress of its packing or of `confining`, whatever its weight makes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/in_units.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/weights.hpp"

namespace polargrain::app {
namespace {

constexpr double kOffWeight = 0.3;       ///< of the larger of both
constexpr double kOffWeightByTimes = 2;  ///< from there on it is another scene
constexpr double kFewKilopascals = 3e3;  ///< Pa
constexpr double kFillAtRest = 0.5;      ///< K0

template <int dim>
void look_at_placed(const Scene& scene, const fem::Problem<dim>& problem, const SceneRegion& region,
                    Remarks& remarks) {
  // An item without a region holds for the ground of the start alone.
  if (std::ranges::any_of(problem.initial_stresses,
                          [&](const auto& item) { return item.region == region.name; }))
    return;
  const double brought =
      region.cell != nullptr
          ? Scene::pressure_of(region)
          : scene.quantity({"materials", region.material, "confining"}, coupler::Dimension::pressure)
                .value_or(0.0);
  const double weight = full_weight(problem, region.name);
  if (!(brought > 0.0) || !(weight > 0.0)) return;  // weight_of_parts tells of no weight
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  for (const int element : region.elements)
    for (const int node : problem.mesh.elements[static_cast<std::size_t>(element)].nodes) {
      const double at = problem.mesh.nodes[static_cast<std::size_t>(node)](dim - 1);
      low = std::min(low, at);
      high = std::max(high, at);
    }
  const double made = 0.5 * weight * (high - low) * (1.0 + (dim - 1) * kFillAtRest) / dim;
  const double more = std::max(brought, made);
  const double times = more / std::min(brought, made);
  if (more * (1.0 - 1.0 / times) <= kFewKilopascals || 1.0 - 1.0 / times <= kOffWeight) return;
  remarks.push_back(
      {times > kOffWeightByTimes ? Rank::wrong : Rank::doubtful, times,
       scene.place({"materials", region.material, region.cell != nullptr ? "packing" : "confining"})
           .fault(fmt::format(
               "region '{}', which a stage places, comes with the {} of its {}; {:.3g} kN/m3 over its {} make {} in its middle",
               region.name, pascals(brought), region.cell != nullptr ? "packing" : "'confining'",
               1e-3 * weight, metres(high - low), pascals(made))),
       fmt::format(
           "initial_stress: [..., {{surface: {:.4g} m, unit_weight: {:.3g} kN/m3, K0: 0.5, region: {}}}]",
           high, 1e-3 * weight, region.name)});
}

}  // namespace

void placed_stress(const Scene& scene, Remarks& remarks) {
  // The problem with the items of all stages.
  scene.the_case().with_problem([&](const auto& problem) {
    for (const SceneRegion& region : scene.regions())
      if (region.comes_later) look_at_placed(scene, problem, region, remarks);
  });
}

}  // namespace polargrain::app
