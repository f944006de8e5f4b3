// SPDX-License-Identifier: GPL-2.0-or-later
// Loads at time zero on the faces of a body in space against the pressure of the grains behind them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "app/remarks/held_in_space.hpp"
#include "app/remarks/in_units.hpp"
#include "app/remarks/kinds.hpp"
#include "fem/element/kinematics.hpp"

namespace polargrain::app {
namespace {

constexpr double kSlackInSpace = 0.02;  // of the pressure: packings are at rest to 1e-3
constexpr double kFarInSpace = 0.3;

/// Pressure of the loads on each face at time zero, Pa, by element and side. Nothing: a traction acts too, or ties do.
std::map<std::pair<int, int>, double> pressures_at_start(const fem::Problem<3>& problem) {
  std::map<std::pair<int, int>, double> carried;
  for (const fem::BoundaryLoad<3>& load : problem.boundary_loads)
    for (const fem::BoundarySide& face : problem.mesh.boundaries.at(load.on))
      carried[{face.element, face.side}] += load.pressure.at(0.0);
  return carried;
}

bool has_other_loads(const fem::Problem<3>& problem) {
  const auto pulls = [](const fem::BoundaryLoad<3>& load) {
    return std::ranges::any_of(load.traction, [](const fem::TimeTable& t) { return t.at(0.0) != 0.0; });
  };
  return !problem.ties.empty() || !problem.node_loads.empty() || !problem.body_loads.empty() ||
         std::ranges::any_of(problem.boundary_loads, pulls);
}

}  // namespace

void loads_at_start_in_space(const Scene& scene, Remarks& remarks) {
  const fem::Problem<3>& problem = *scene.the_case().space;
  if (scene.stress_at_start() != Scene::StressAtStart::materials || has_other_loads(problem))
    return;  // their balance takes a solution
  const auto held = held_nodes_in_space(problem);
  const auto carried = pressures_at_start(problem);
  for (const auto& [name, faces] : problem.mesh.boundaries) {
    double worst = 0.0;
    double here = 0.0;
    double behind = 0.0;
    for (const fem::BoundarySide& face : faces) {
      const SceneRegion& region = scene.region_of(face.element);
      const double pressure = Scene::pressure_of(region);
      if (region.cell == nullptr || region.comes_later || pressure <= 0.0 ||
          is_held(problem.mesh, problem.mesh.side_nodes(face), held))
        continue;
      const auto found = carried.find({face.element, face.side});
      const double load = found == carried.end() ? 0.0 : found->second;
      const double off = std::abs(load - pressure) / std::max(std::abs(load), pressure);
      if (off <= worst) continue;
      worst = off;
      here = load;
      behind = pressure;
    }
    if (worst <= kSlackInSpace) continue;
    const coupler::Entry* const value = scene.boundary_value(name, "pressure");
    const coupler::Entry& place = value != nullptr ? *value : scene.place({"boundary"});
    remarks.push_back(
        {worst > kFarInSpace ? Rank::wrong : Rank::doubtful, std::max(1.0, worst / kSlackInSpace),
         place.fault(fmt::format(
             "boundary: '{}' carries {} at time zero, its grains {}: the first step, 0, has to take up {:.0f} % of that "
             "pressure",
             name, here == 0.0 ? "nothing" : pascals(here), pascals(behind), 100.0 * worst)),
         here == 0.0
             ? fmt::format("give it 'pressure: {}', or hold it: {{on: {}, fix: [...]}}", pascals(behind),
                           name)
             : fmt::format(
                   "settle the packing to {0} (polargrain pack --settle PACKING SCRIPT -o NEW.h5 --set "
                   "pressure='{0}'), or begin where the packing is: pressure: [[0, {1}], [1, {0}]]",
                   pascals(here), pascals(behind))});
  }
}

}  // namespace polargrain::app
