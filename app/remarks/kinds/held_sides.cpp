// SPDX-License-Identifier: GPL-2.0-or-later
// Ground with weight between sides that hold it up.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/remarks/kinds.hpp"
#include "app/remarks/outline.hpp"
#include "fem/mesh/box_around.hpp"

namespace polargrain::app {
namespace {

/// Names of the boundaries, one at each end of the body across an axis, that hold all of it up.
template <int dim>
std::vector<std::string> sides_that_hold(const fem::Problem<dim>& problem, int axis) {
  const HeldNodes<dim> held = held_nodes(problem);
  const fem::BoxAround<dim> box = fem::box_around(problem.mesh);
  const double slack = 1e-6 * box.sides()(axis);
  std::vector<std::string> found;
  for (const double end : {box.least(axis), box.largest(axis)}) {
    for (const auto& [name, unused] : problem.mesh.boundaries) {
      const std::vector<OutlineSide<dim>> along = sides_of(problem.mesh, name);
      const bool is_side = !along.empty() && std::ranges::all_of(along, [&](const OutlineSide<dim>& side) {
        return std::abs(side.centre(axis) - end) < slack && std::abs(side.normal(axis)) > 0.999;
      });
      if (!is_side || !held_along(along, held).all[dim - 1]) continue;
      found.push_back(name);
      break;
    }
  }
  return found;
}

template <int dim>
void look_at_silo(const Scene& scene, const fem::Problem<dim>& problem, int axis, Remarks& remarks) {
  const std::vector<std::string> sides = sides_that_hold(problem, axis);
  if (sides.size() < 2) return;
  const double width = scene.body().sides[static_cast<std::size_t>(axis)];
  const double height = scene.body().height();
  const coupler::Entry* const value = scene.boundary_value(sides[0], "fix");
  remarks.push_back(
      {Rank::doubtful, std::max(1.0, height / width),
       (value != nullptr ? *value : scene.place({"boundary"}))
           .fault(fmt::format(
               "boundary: u{} is fixed along '{}' and '{}': the ground between them hangs on its sides, as in "
               "a silo {:.3g} m wide and {:.3g} m high",
               dim, sides[0], sides[1], width, height)),
       fmt::format("ground that goes on beyond the mesh slides there: fix: [u{}]", axis + 1)});
}

template <int dim>
void look_at_silos(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  const bool heavy = std::ranges::any_of(problem.body_loads, [&](const fem::BodyLoad<dim>& load) {
    return load.density(problem.mesh.nodes.front())(dim - 1) < 0.0;
  });
  for (int axis = 0; heavy && axis < dim - 1; ++axis) look_at_silo(scene, problem, axis, remarks);
}

}  // namespace

void held_sides(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_at_silos(scene, problem, remarks); });
}

}  // namespace polargrain::app
