// SPDX-License-Identifier: GPL-2.0-or-later
// The same pressure or weight given twice to one place, as by a name for the whole and one for a part: they add up.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "app/remarks/kinds.hpp"

namespace polargrain::app {
namespace {

bool are_alike(const fem::TimeTable& one, const fem::TimeTable& other) {
  return one == other && one.largest_magnitude() > 0.0;
}

template <int dim>
void look_at_pressures(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  const auto sides_of = [&](const std::string& on) {
    std::set<std::pair<int, int>> sides;
    for (const fem::BoundarySide& side : problem.mesh.boundaries.at(on))
      sides.insert({side.element, side.side});
    return sides;
  };
  for (std::size_t a = 0; a < problem.boundary_loads.size(); ++a)
    for (std::size_t b = a + 1; b < problem.boundary_loads.size(); ++b) {
      const auto& [one, other] = std::tie(problem.boundary_loads[a], problem.boundary_loads[b]);
      if (!one.life.overlaps(other.life) || !are_alike(one.pressure, other.pressure)) continue;
      const auto there = sides_of(other.on);
      const auto both =
          std::ranges::count_if(sides_of(one.on), [&](const auto& side) { return there.contains(side); });
      if (both == 0) continue;
      const coupler::Entry* const value = scene.boundary_value(other.on, "pressure");
      remarks.push_back(
          {Rank::doubtful, 2.0,
           (value != nullptr ? *value : scene.place({"boundary"}))
               .fault(fmt::format(
                   "boundary: {} sides carry the same pressure, of up to {:.4g} kPa, twice: as '{}' and as "
                   "'{}'",
                   both, 1e-3 * one.pressure.largest_magnitude(), one.on, other.on)),
           "pressures of several items add up: remove one of the two, or give their sum"});
    }
}

template <int dim>
void look_at_weights(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  const auto& place = problem.mesh.nodes.front();
  for (std::size_t a = 0; a < problem.body_loads.size(); ++a)
    for (std::size_t b = a + 1; b < problem.body_loads.size(); ++b) {
      const auto& [one, other] = std::tie(problem.body_loads[a], problem.body_loads[b]);
      const bool is_one_place = one.region == other.region || one.region.empty() || other.region.empty();
      if (!is_one_place || !one.life.overlaps(other.life) || one.density(place) != other.density(place) ||
          !are_alike(one.factor, other.factor) || one.density(place).isZero(0.0))
        continue;
      const std::string& region = one.region.empty() ? other.region : one.region;
      remarks.push_back(
          {Rank::wrong, 2.0,
           scene.place({"body"}).fault(
               fmt::format("body: {} has the same force of {:.4g} kN/m3 twice",
                           region.empty() ? std::string("all ground") : fmt::format("region '{}'", region),
                           1e-3 * one.density(place).norm() * one.factor.largest_magnitude())),
           "an item without a region is for all of the body, and items add up: remove one of the two"});
    }
}

}  // namespace

void loads_twice(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) {
    look_at_pressures(scene, problem, remarks);
    look_at_weights(scene, problem, remarks);
  });
}

}  // namespace polargrain::app
