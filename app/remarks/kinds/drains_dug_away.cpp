// SPDX-License-Identifier: GPL-2.0-or-later
// Ground that a stage removes together with its drained side: the new surface is closed to water unless the case says otherwise.
#include <fmt/format.h>

#include <algorithm>

#include "app/remarks/kinds.hpp"
#include "fem/water/pore_water.hpp"

namespace polargrain::app {
namespace {

/// Elements beside a boundary that are there. @param there as fem::elements_in_stage has it
template <int dim>
bool has_ground(const fem::Problem<dim>& problem, const std::string& boundary,
                const std::vector<char>& there) {
  const auto sides = problem.mesh.boundaries.find(boundary);
  return sides != problem.mesh.boundaries.end() &&
         std::ranges::any_of(sides->second, [&](const fem::BoundarySide& side) {
           return there.empty() || there[static_cast<std::size_t>(side.element)] != 0;
         });
}

/// Nodes of ground that stays, which a stage lays bare.
template <int dim>
std::vector<char> laid_bare(const fem::Problem<dim>& problem, const std::vector<char>& before,
                            const std::vector<char>& now) {
  std::vector<char> gone(now.size(), 0);
  for (std::size_t e = 0; e < now.size(); ++e)
    gone[e] = (before.empty() || before[e] != 0) && now[e] == 0 ? 1 : 0;
  std::vector<char> bare = fem::nodes_of_elements(problem.mesh, gone);
  const std::vector<char> left = fem::nodes_of_elements(problem.mesh, now);
  for (std::size_t node = 0; node < bare.size(); ++node)
    if (left[node] == 0) bare[node] = 0;
  return bare;
}

template <int dim>
void look_at_drains(const Scene& scene, const fem::Problem<dim>& problem, const fem::PoreWater<dim>& water,
                    int stage, Remarks& remarks) {
  const std::vector<char> before = fem::elements_in_stage(problem, stage - 1);
  const std::vector<char> now = fem::elements_in_stage(problem, stage);
  if (now.empty()) return;
  std::vector<char> closed = laid_bare(problem, before, now);
  const auto all = std::ranges::count(closed, 1);
  for (const fem::PrescribedField<dim>& given : problem.prescribed_fields)
    if (given.field == fem::kPorePressure && given.life.holds(stage))
      for (const int node : problem.mesh.nodes_on(given.on)) closed[static_cast<std::size_t>(node)] = 0;
  for (const fem::OpenSide& side : water.options().open_sides)
    if (side.holds(stage))
      for (const int node : problem.mesh.nodes_on(side.on)) closed[static_cast<std::size_t>(node)] = 0;
  // Drained sides beside it share its ends.
  if (2 * std::ranges::count(closed, 1) <= all) return;
  for (const fem::PrescribedField<dim>& given : problem.prescribed_fields) {
    if (given.field != fem::kPorePressure || !given.life.holds(stage - 1) ||
        !has_ground(problem, given.on, before) || has_ground(problem, given.on, now))
      continue;
    remarks.push_back(
        {Rank::doubtful, 2.0,
         scene.place({"steps", "stages"})
             .fault(fmt::format(
                 "steps: stage '{}' removes the ground at '{}', whose water had a given pressure: the surface that it lays bare is "
                 "closed to water",
                 problem.stages[static_cast<std::size_t>(stage)], given.on)),
         "give that surface a name below 'lines' of the mesh, and in the stage boundary: [{on: NAME, water_level: HEIGHT}] "
         "where it is pumped dry, or 'free_water'"});
    return;
  }
}

}  // namespace

void drains_dug_away(const Scene& scene, Remarks& remarks) {
  const auto look = [&]<int dim>(const fem::Problem<dim>& problem) {
    const fem::PoreWater<dim>* const water = fem::pore_water_of(problem);
    if (water == nullptr ||
        std::ranges::all_of(water->regions(), [](const auto& region) { return region.second.undrained; }))
      return;
    for (int stage = 1; stage < static_cast<int>(problem.stages.size()); ++stage)
      look_at_drains<dim>(scene, problem, *water, stage, remarks);
  };
  // Not Scene::with_problem: conditions that begin in a later stage matter here.
  scene.the_case().with_problem(look);
}

}  // namespace polargrain::app
