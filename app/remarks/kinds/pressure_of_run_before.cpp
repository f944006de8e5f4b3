// SPDX-License-Identifier: GPL-2.0-or-later
// Loads at time zero against the stress that the run to start from has left behind them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "app/remarks/in_units.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/outline.hpp"

namespace polargrain::app {
namespace {

constexpr double kFarFromRun = 2.0;  // a load over the pressure behind it, or the other way round
/// Of the mean pressure of the run: a coarse mesh knows the stress at a surface no better.
constexpr double kSmallOfRun = 0.05;
constexpr double kNothingLeft = 1e3;  // times, where nothing pushes against the load

/// Means over the sides of a boundary that may move along their normals, Pa.
struct LoadOnEnd {
  double carried = 0.0;
  double behind = 0.0;
};

/// Pressure of all loads on a side at time zero, Pa.
template <int dim>
double pressure_on(const fem::Problem<dim>& problem, const OutlineSide<dim>& side) {
  double pressure = 0.0;
  for (const fem::BoundaryLoad<dim>& load : problem.boundary_loads) {
    if (std::ranges::find(side.names, load.on) == side.names.end()) continue;
    pressure += load.pressure.at(0.0);
    for (std::size_t i = 0; i < dim; ++i)
      pressure -= load.traction[i].at(0.0) * side.normal(static_cast<Eigen::Index>(i));
  }
  return pressure;
}

/// Nothing where no side is free, or no stress is known. @param stresses of the boundary's sides, in their order
template <int dim>
std::optional<LoadOnEnd> load_on_end(const Scene& scene, const fem::Problem<dim>& problem,
                                     const std::string& boundary,
                                     const std::vector<Eigen::Matrix3d>& stresses,
                                     const HeldNodes<dim>& held) {
  const std::vector<fem::BoundarySide>& sides = problem.mesh.boundaries.at(boundary);
  LoadOnEnd sum;
  double size = 0.0;
  for (const OutlineSide<dim>& side : scene.outline<dim>()) {
    const auto found = std::ranges::find_if(sides, [&](const fem::BoundarySide& one) {
      return one.element == side.element && one.side == side.number;
    });
    const auto number = static_cast<std::size_t>(found - sides.begin());
    if (number >= stresses.size() || held_along<dim>({side}, held).normal) continue;
    const typename Cosserat<dim>::Gradient stress = stresses[number].template topLeftCorner<dim, dim>();
    if (!stress.allFinite()) continue;
    sum.carried += side.size * pressure_on(problem, side);
    sum.behind -= side.size * side.normal.dot(stress * side.normal);
    size += side.size;
  }
  if (size == 0.0) return {};
  return LoadOnEnd{sum.carried / size, sum.behind / size};
}

template <int dim>
void compare_loads(const Scene& scene, const fem::Problem<dim>& problem, const coupler::RunBefore& before,
                   Remarks& remarks) {
  // The stress that a tie or single forces add to a boundary is not known.
  std::set<std::string> others;
  for (const fem::Tie& tie : problem.ties) others.insert({tie.on, tie.to});
  for (const fem::NodeLoad& load : problem.node_loads) others.insert(load.on);
  const HeldNodes<dim> held = carried_nodes(problem);
  for (const auto& [boundary, stresses] : before.behind) {
    if (others.contains(boundary)) continue;
    const std::optional<LoadOnEnd> load = load_on_end(scene, problem, boundary, stresses, held);
    if (!load || load->carried <= 0.0 ||
        std::abs(load->carried - load->behind) <= kSmallOfRun * before.pressure)
      continue;
    const double ratio = load->behind > 0.0
                             ? std::max(load->carried / load->behind, load->behind / load->carried)
                             : kNothingLeft;
    if (ratio <= kFarFromRun) continue;
    const coupler::Entry* value = nullptr;
    for (const char* const key : {"pressure", "traction"})
      if (value == nullptr) value = scene.boundary_value(boundary, key);
    const coupler::Entry& place = value != nullptr ? *value : scene.place({"start_from"});
    remarks.push_back(
        {Rank::doubtful, std::min(ratio, kNothingLeft),
         place.fault(fmt::format(
             "start_from: '{}' carries {} at time zero, and '{}' has left {} behind it: step 0 takes up the difference at once",
             boundary, pascals(load->carried), before.name, pascals(load->behind))),
         fmt::format(
             "begin with the load of that run, and change it over steps: [[0, {}], [1, {}]]; or start from another run",
             pascals(std::max(load->behind, 0.0)), pascals(load->carried))});
  }
}

}  // namespace

void pressure_of_run_before(const Scene& scene, Remarks& remarks) {
  const auto& before = scene.the_case().run_before;
  if (!before || before->behind.empty()) return;
  scene.with_problem([&](const auto& problem) { compare_loads(scene, problem, *before, remarks); });
}

}  // namespace polargrain::app
