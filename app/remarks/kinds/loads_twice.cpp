// SPDX-License-Identifier: GPL-2.0-or-later
// The same pressure or weight given twice to one place, as by a name for the whole and one for a part: they add up.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

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

/// Weights of two items, N/m^3, downwards positive, at the end of the step at which they weigh most together.
template <int dim>
std::pair<double, double> weights_together(const Scene& scene, const fem::BodyLoad<dim>& one,
                                           const fem::BodyLoad<dim>& other,
                                           const typename Cosserat<dim>::Place& place) {
  std::vector<double> times{0.0};
  for (const coupler::StepTarget& target : scene.the_case().plan)
    times.push_back(scene.end_time() ? target.amount : 1.0);
  std::pair<double, double> most;
  for (const double time : times) {
    const std::pair<double, double> now{-one.factor.at(time) * one.density(place)(dim - 1),
                                        -other.factor.at(time) * other.density(place)(dim - 1)};
    if (now.first + now.second > most.first + most.second) most = now;
  }
  return most;
}

/// Two weights of one place, each of which could be the whole one.
template <int dim>
void look_at_sum_of_weights(const Scene& scene, const fem::BodyLoad<dim>& one,
                            const fem::BodyLoad<dim>& other, const typename Cosserat<dim>::Place& place,
                            Remarks& remarks) {
  constexpr double kHeaviest = 28e3;  // N/m^3: reinforced concrete has 25, rock 27
  constexpr double kLikeAWhole = 3.0;
  constexpr double kNearlyAlike = 1.25;
  const auto [first, second] = weights_together(scene, one, other, place);
  const double less = std::min(first, second);
  const double more = std::max(first, second);
  const bool has_own = one.region != other.region;
  if (less <= 0.0 || more > kLikeAWhole * less ||
      (first + second <= kHeaviest && !(has_own && more <= kNearlyAlike * less)))
    return;
  const std::string& region = one.region.empty() ? other.region : one.region;
  remarks.push_back(
      {Rank::doubtful, 3.0,
       scene.place({"body"}).fault(
           fmt::format("body: {} has {:.4g} and {:.4g} kN/m3, of two items: {:.4g} kN/m3 together",
                       region.empty() ? std::string("all ground") : fmt::format("region '{}'", region),
                       1e-3 * first, 1e-3 * second, 1e-3 * (first + second))),
       "an item without a region is for all of the body, and items add up: give each region one item (region: NAME)"});
}

template <int dim>
void look_at_weights(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  const auto& place = problem.mesh.nodes.front();
  for (std::size_t a = 0; a < problem.body_loads.size(); ++a)
    for (std::size_t b = a + 1; b < problem.body_loads.size(); ++b) {
      const auto& [one, other] = std::tie(problem.body_loads[a], problem.body_loads[b]);
      const bool is_one_place = one.region == other.region || one.region.empty() || other.region.empty();
      if (!is_one_place || !one.life.overlaps(other.life)) continue;
      if (one.density(place) != other.density(place) || !are_alike(one.factor, other.factor)) {
        look_at_sum_of_weights(scene, one, other, place, remarks);
        continue;
      }
      if (one.density(place).isZero(0.0)) continue;
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
