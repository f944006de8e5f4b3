// SPDX-License-Identifier: GPL-2.0-or-later
// Movements that strain nothing: all that is given along an axis moves alike.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/in_units.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/outline.hpp"

namespace polargrain::app {
namespace {

/// Share of the largest movement below which two are alike.
constexpr double kAlike = 1e-6;

template <int dim>
const fem::PrescribedDof<dim>* first_that_moves(const fem::Problem<dim>& problem, fem::Dof dof) {
  for (const fem::PrescribedDof<dim>& item : problem.prescribed)
    if (item.dof == dof && item.value.largest_magnitude() > 0.0) return &item;
  return nullptr;
}

template <int dim>
void look_at_ways(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  const auto end = scene.end_time();
  if (scene.the_case().real_time) return;  // inertia strains a body that is carried along
  if (!end || !problem.ties.empty()) return;
  for (int axis = 0; axis < dim; ++axis) {
    const fem::Dof dof = fem::node_dofs<dim>()[static_cast<std::size_t>(axis)];
    double least = HUGE_VAL, largest = -HUGE_VAL;
    int count = 0;
    for (const std::optional<double>& given : given_at(problem, dof, *end)) {
      if (!given) continue;
      ++count;
      least = std::min(least, *given);
      largest = std::max(largest, *given);
    }
    const double size = std::max(std::abs(least), std::abs(largest));
    const fem::PrescribedDof<dim>* const item = first_that_moves(problem, dof);
    if (count < 2 || item == nullptr || size == 0.0 || largest - least > kAlike * size) continue;
    const coupler::Entry* const value = scene.boundary_value(item->on, "move");
    remarks.push_back(
        {Rank::wrong, 10.0,
         (value != nullptr ? *value : scene.place({"boundary"}))
             .fault(fmt::format(
                 "boundary: all that is given along {} moves by {}: the body is carried along, and not strained",
                 axis + 1, metres(largest))),
         fmt::format("hold the opposite boundary with 'fix: [u{}]', or move it the other way", axis + 1)});
  }
}

}  // namespace

void carried_along(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_at_ways(scene, problem, remarks); });
}

}  // namespace polargrain::app
