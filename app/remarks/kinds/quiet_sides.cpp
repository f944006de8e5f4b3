// SPDX-License-Identifier: GPL-2.0-or-later
// Quiet boundaries beside a base that moves, and under loads that stay.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/base_motions.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/outline.hpp"
#include "fem/solver/loads.hpp"

namespace polargrain::app {
namespace {

const coupler::Entry& place_of_quiet(const Scene& scene, const std::string& boundary) {
  const coupler::Entry* const value = scene.boundary_value(boundary, "quiet");
  return value != nullptr ? *value : scene.place({"boundary"});
}

template <int dim>
bool is_quiet(const fem::Problem<dim>& problem, const std::string& place) {
  return std::ranges::find(problem.quiet, place) != problem.quiet.end();
}

/// Whether a place lies in the lower half of the body.
template <int dim>
bool lies_low(const Scene& scene, const fem::Mesh<dim>& mesh, const std::vector<int>& nodes) {
  const double middle = scene.body().bottom + 0.5 * scene.body().height();
  return std::ranges::all_of(
      nodes, [&](int node) { return mesh.nodes[static_cast<std::size_t>(node)](dim - 1) < middle; });
}

/// Whether the ground stands on a boundary, as on a shelf of rock that may lie high.
template <int dim>
bool carries_ground(const fem::Mesh<dim>& mesh, const std::string& boundary) {
  constexpr double kFacesDown = 0.5;  // of its size, seen from above: walls that lean are steeper
  double size = 0.0;
  double down = 0.0;
  for (const OutlineSide<dim>& side : outline_of(mesh)) {
    if (std::ranges::find(side.names, boundary) == side.names.end()) continue;
    size += side.size;
    down -= side.size * side.normal(dim - 1);
  }
  return down > kFacesDown * size;
}

/// Dashpots pull against the ground at rest. At the sides of ground that its base shakes they hold it back.
template <int dim>
void look_beside_base(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  for (const fem::PrescribedDof<dim>& item : problem.prescribed) {
    if (fem::is_rotation(item.dof) || !item.value.changes() || is_quiet(problem, item.on)) continue;
    const std::vector<int> base = problem.mesh.nodes_on(item.on);
    if (!lies_low(scene, problem.mesh, base) && !carries_ground(problem.mesh, item.on)) continue;
    for (const std::string& side : problem.quiet) {
      const std::vector<int> nodes = problem.mesh.nodes_on(side);
      if (std::ranges::none_of(base, [&](int node) { return std::ranges::find(nodes, node) != nodes.end(); }))
        continue;
      remarks.push_back(
          {Rank::wrong, 2.0,
           place_of_quiet(scene, side)
               .fault(fmt::format(
                   "boundary: '{}' is quiet beside '{}', which moves: its dashpots pull against ground at rest, "
                   "and hold the shaken ground back",
                   side, item.on)),
           "leave quiet out at the sides and tie them, '{on: left, tie: right}'; a wide mesh keeps echoes away"});
      return;
    }
  }
}

/// Resultant of nodal forces along each axis, N; in the plane per m.
template <int dim>
typename Cosserat<dim>::Place resultant(const fem::Mesh<dim>& mesh, const Eigen::VectorXd& forces) {
  typename Cosserat<dim>::Place sum = Cosserat<dim>::Place::Zero();
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    sum += forces.segment<dim>(static_cast<Eigen::Index>(fem::entry_of<dim>(node)));
  return sum;
}

/// Dashpots hold no load: under one that stays the body moves on at an even speed.
template <int dim>
void look_at_lasting_loads(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  using Place = typename Cosserat<dim>::Place;
  // Ways of a shear wave through the body: over fewer a load that stays is that on an endless body.
  constexpr double kWaysOfWave = 4.0;
  constexpr double kLasts = 0.5;  // mean over the largest value: vibrations and pulses have less
  constexpr double kRounding = 1e-6;
  constexpr int kLooks = 101;
  const auto end = scene.end_time();
  const auto passes = [&](const SceneRegion& region) {
    const auto speed = shear_speed(scene, region);
    return !speed || *speed * *end > kWaysOfWave * scene.body().larger_side();
  };
  if (!end || std::ranges::none_of(scene.regions(), passes)) return;
  const fem::Loads<dim> loads(problem);
  const Place first = resultant<dim>(problem.mesh, loads.at(0.0));
  Place mean = Place::Zero();
  Place most = Place::Zero();
  for (int look = 1; look <= kLooks; ++look) {
    const Place change =
        resultant<dim>(problem.mesh, loads.at(*end * 0.5 * (1.0 + static_cast<double>(look) / kLooks))) -
        first;
    mean += change / kLooks;
    most = most.cwiseMax(change.cwiseAbs());
  }
  for (int axis = 0; axis < dim; ++axis) {
    const fem::Dof dof = fem::node_dofs<dim>()[static_cast<std::size_t>(axis)];
    const auto holds = [&](const fem::PrescribedDof<dim>& item) {
      return item.dof == dof && !is_quiet(problem, item.on);
    };
    const double lasting = std::abs(mean(axis));
    if (lasting <= kLasts * most(axis) || lasting <= kRounding * loads.largest_force() ||
        std::ranges::any_of(problem.prescribed, holds))
      continue;
    remarks.push_back(
        {Rank::doubtful, 2.0,
         place_of_quiet(scene, problem.quiet.front())
             .fault(fmt::format(
                 "boundary: loads along {0} stay {1:.3g} {2} away from those of the start, and quiet "
                 "boundaries alone hold the body along {0}: it drifts on",
                 axis + 1, 1e-3 * lasting, dim == 2 ? "kN/m" : "kN")),
         fmt::format(
             "hold a boundary along {} without quiet, far enough for its echoes to come late; or let the load end",
             axis + 1)});
  }
}

}  // namespace

void quiet_sides(const Scene& scene, Remarks& remarks) {
  if (!scene.the_case().real_time) return;
  scene.with_problem([&](const auto& problem) {
    if (problem.quiet.empty()) return;
    look_beside_base(scene, problem, remarks);
    look_at_lasting_loads(scene, problem, remarks);
  });
}

}  // namespace polargrain::app
