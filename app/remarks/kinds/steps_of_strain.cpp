// SPDX-License-Identifier: GPL-2.0-or-later
// The strain, or the load, of a step against what the material takes as elastic.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"

namespace polargrain::app {
namespace {

constexpr double kMostOfElastic = 3.0;  // elastic strains of the packing a step
constexpr double kMostOfLaw = 0.02;     // strain a step, of laws with a strength
constexpr double kMostOfLoad = 0.5;     // of the pressure of the grains

/// Largest change of a pressure or traction in one step of a run under time, Pa.
double largest_load_step(const Scene& scene) {
  double largest = 0.0;
  double before = 0.0;
  for (const coupler::StepTarget& target : scene.the_case().plan) {
    if (target.control != coupler::StepTarget::Control::time) break;
    const auto change = [&](const fem::TimeTable& table) {
      largest = std::max(largest, std::abs(table.at(target.amount) - table.at(before)));
    };
    scene.with_problem([&](const auto& problem) {
      for (const auto& load : problem.boundary_loads) {
        change(load.pressure);
        for (const fem::TimeTable& along : load.traction) change(along);
      }
    });
    before = target.amount;
  }
  return largest;
}

/// Movements that leave the grains where they rest; loads would have to change for more.
void of_nothing(const Scene& scene, const SceneRegion& region, double elastic, Remarks& remarks) {
  constexpr double kLeastOfElastic = 0.01;  // elastic strains of the packing in the whole run
  const double whole = scene.strain_of_run();
  const bool only_moved = scene.end_time().has_value() && largest_load_step(scene) == 0.0 &&
                          scene.with_problem([](const auto& problem) {
                            return problem.body_loads.empty() && problem.node_loads.empty();
                          });
  if (!only_moved || whole <= 0.0 || whole >= kLeastOfElastic * elastic) return;
  remarks.push_back(
      {Rank::doubtful, kLeastOfElastic * elastic / whole,
       scene.place({"boundary"})
           .fault(fmt::format(
               "boundary: all movements strain the body by {:.2g}, {:.2g} elastic strains of the packing of '{}' ({:.2g}): its "
               "stress changes by less than grains answer to",
               whole, whole / elastic, region.material, elastic)),
       "check the unit of the movement"});
}

/// Newton's method asks boxes of stiff spheres thousands of times, and stops soon (docs/theory/explicit.md); explicit steps take
/// less time for discs too, from an elastic strain a step on (docs/howto/method.md).
std::string proposal(const SceneRegion& region) {
  return region.cell->packing.dimension == 3
             ? "'method: explicit', which carries spheres where Newton's method stops, or "
             : "'method: explicit', which takes less time for such steps, or ";
}

void of_cells(const Scene& scene, const SceneRegion& region, Remarks& remarks) {
  const double strain = scene.strain_of_step();
  const double elastic = region.packing != nullptr ? region.packing->elastic_strain() : 0.0;
  // Explicit steps are far smaller than the rows that they are written in.
  if (elastic > 0.0 && strain > kMostOfElastic * elastic && !scene.the_case().is_explicit())
    remarks.push_back(
        {Rank::doubtful, strain / elastic / kMostOfElastic,
         scene.place({"steps", "count"})
             .fault(fmt::format(
                 "steps: a step strains the body by {:.2g}, {:.3g} elastic strains of the packing of '{}' ({:.2g}): a peak lies "
                 "between two rows, and iterations fail",
                 strain, strain / elastic, region.material, elastic)),
         fmt::format("{}count: {:.0f} or more", proposal(region),
                     std::ceil(scene.the_case().steps() * strain / elastic))});
  if (elastic > 0.0) of_nothing(scene, region, elastic, remarks);
  const double pressure = Scene::pressure_of(region);
  const double load = largest_load_step(scene);
  if (pressure > 0.0 && load > kMostOfLoad * pressure)
    remarks.push_back(
        {Rank::doubtful, load / pressure / kMostOfLoad,
         scene.place({"steps", "count"})
             .fault(fmt::format(
                 "steps: one step changes a load by {:.4g} kPa, {:.0f} % of the pressure of the grains of '{}'",
                 1e-3 * load, 100.0 * load / pressure, region.material)),
         "more steps (count), so that a step changes a load by a tenth of that pressure"});
}

/// A law that yields is led along its way: the end alone is not the way.
void of_one_step(const Scene& scene, Remarks& remarks) {
  if (scene.the_case().steps() > 1) return;
  for (const SceneRegion& region : scene.regions()) {
    if (region.cell != nullptr || !is_strong(scene, region)) continue;
    remarks.push_back(
        {Rank::doubtful, 1.0,
         scene.place({"steps", "count"})
             .fault(
                 fmt::format("steps: 1 for all loads, and material '{}' yields: the curve has one point, and "
                             "the way to that point stays unseen",
                             region.material)),
         "count: 10 or more"});
    return;
  }
}

}  // namespace

void steps_of_strain(const Scene& scene, Remarks& remarks) {
  of_one_step(scene, remarks);
  for (const SceneRegion& region : scene.regions()) {
    if (region.cell != nullptr) {
      of_cells(scene, region, remarks);
    } else if (is_strong(scene, region) && scene.strain_of_step() > kMostOfLaw) {
      remarks.push_back(
          {Rank::doubtful, scene.strain_of_step() / kMostOfLaw,
           scene.place({"steps", "count"})
               .fault(fmt::format(
                   "steps: {} of them, and each strains the body by {:.2g} %: a peak lies between two rows",
                   scene.the_case().steps(), 100.0 * scene.strain_of_step())),
           fmt::format("count: {:.0f} or more",
                       std::ceil(scene.the_case().steps() * scene.strain_of_step() / 2e-3))});
    }
  }
}

}  // namespace polargrain::app
