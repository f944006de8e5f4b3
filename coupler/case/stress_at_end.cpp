// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/stress_at_end.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "common/prefixed_archive.hpp"
#include "common/record_archive.hpp"
#include "fem/solver/later_regions.hpp"
#include "fem/solver/recovery.hpp"

namespace polargrain::coupler {
namespace {

template <int dim>
using Responses = std::vector<Response<dim>>;

template <int dim>
Responses<dim> responses_at_end(Checkpoint& end, std::size_t points) {
  PrefixedReader solver(end.state, "solver/");
  try {
    return read_records<Response<dim>>(solver, "responses", points);
  } catch (const RunError&) {
    return {};  // a run that starts from there says what is damaged
  }
}

/// Number at the end, by element of this case; nothing where its region has no element there, or comes later.
template <int dim>
std::vector<std::optional<std::size_t>> regions_at_end(const fem::Problem<dim>& problem,
                                                       const fem::Recovery<dim>& recovery,
                                                       const std::vector<std::string>& known) {
  std::vector<std::optional<std::size_t>> numbers(problem.mesh.elements.size());
  for (const auto& [region, material] : problem.materials) {
    const auto number = static_cast<std::size_t>(std::ranges::find(known, region) - known.begin());
    if (number == known.size() || fem::comes_later(problem, region) || !recovery.has(number)) continue;
    for (const int e : problem.mesh.regions.at(region)) numbers[static_cast<std::size_t>(e)] = number;
  }
  return numbers;
}

/// Whether something loads a boundary at time zero.
template <int dim>
bool loads_at_once(const fem::Problem<dim>& problem) {
  return std::ranges::any_of(problem.boundary_loads, [](const fem::BoundaryLoad<dim>& load) {
    return load.pressure.at(0.0) != 0.0 ||
           std::ranges::any_of(load.traction,
                               [](const fem::TimeTable& table) { return table.at(0.0) != 0.0; });
  });
}

/// -(s11 + s22) / 2 in the plane, a third of the three in space: mean over the points that are there.
template <int dim>
double mean_pressure(const fem::EndOfRun<dim>& body,
                     const std::vector<typename fem::EndOfRun<dim>::Point>& points,
                     const Responses<dim>& responses) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (body.there[static_cast<std::size_t>(points[i].element)] == 0) continue;
    for (int j = 0; j < dim; ++j) sum -= responses[i].stress(Cosserat<dim>::stress_place(j, j)) / dim;
    ++count;
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

}  // namespace

template <int dim>
void add_stress_at_end(Checkpoint& end, const fem::EndOfRun<dim>& body, const fem::Problem<dim>& problem,
                       RunBefore& before) {
  const std::vector<std::string> known = regions_of(end.identity);
  if (!loads_at_once(problem) || known.size() != body.material_of_region.size()) return;
  const std::vector<typename fem::EndOfRun<dim>::Point> points = body.points();
  const Responses<dim> responses = responses_at_end<dim>(end, points.size());
  if (responses.size() != points.size() || points.empty()) return;
  before.pressure = mean_pressure(body, points, responses);
  fem::Recovery<dim> recovery(body);
  const auto regions = regions_at_end(problem, recovery, known);
  // Numbers of the points of each material, by their number among them.
  std::vector<std::vector<std::size_t>> numbers(body.material_of_region.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    numbers[body.material_of_region[body.region_of_element[static_cast<std::size_t>(points[i].element)]]]
        .push_back(i);
  const auto stress_behind = [&](const fem::BoundarySide& side) {
    const std::optional<std::size_t> region = regions[static_cast<std::size_t>(side.element)];
    if (!region) return Eigen::Matrix3d(Eigen::Matrix3d::Constant(NAN));
    typename Cosserat<dim>::Place centre = Cosserat<dim>::Place::Zero();
    const auto corners = static_cast<std::size_t>(problem.mesh.side_of(side).type->corners);
    const std::vector<int> nodes = problem.mesh.side_nodes(side);
    for (std::size_t k = 0; k < corners; ++k)
      centre += problem.mesh.nodes[static_cast<std::size_t>(nodes[k])] / static_cast<double>(corners);
    Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
    const fem::PointMean mean = recovery.at(centre, *region).mean;
    for (const auto& [point, weight] : mean.parts) {
      const auto& there = responses[numbers[body.material_of_region[*region]][point]].stress;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j) stress(i, j) += weight * there(Cosserat<dim>::stress_place(i, j));
    }
    return stress;
  };
  for (const fem::BoundaryLoad<dim>& load : problem.boundary_loads) {
    const auto [behind, is_new] = before.behind.try_emplace(load.on);
    if (!is_new) continue;
    for (const fem::BoundarySide& side : problem.mesh.boundaries.at(load.on))
      behind->second.push_back(stress_behind(side));
  }
}

template void add_stress_at_end<2>(Checkpoint&, const fem::EndOfRun<2>&, const fem::Problem<2>&, RunBefore&);
template void add_stress_at_end<3>(Checkpoint&, const fem::EndOfRun<3>&, const fem::Problem<3>&, RunBefore&);

}  // namespace polargrain::coupler
