// SPDX-License-Identifier: GPL-2.0-or-later
// Movements that strain nothing: all that is given along an axis moves alike.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/in_units.hpp"
#include "app/remarks/kinds.hpp"

namespace polargrain::app {
namespace {

/// Share of the largest movement below which two are alike.
constexpr double kAlike = 1e-6;

const fem::PrescribedDof<2>* first_that_moves(const Scene& scene, fem::Dof dof) {
  for (const fem::PrescribedDof<2>& item : scene.problem().prescribed)
    if (item.dof == dof && item.value.largest_magnitude() > 0.0) return &item;
  return nullptr;
}

}  // namespace

void carried_along(const Scene& scene, Remarks& remarks) {
  const auto end = scene.end_time();
  if (scene.the_case().real_time) return;  // inertia strains a body that is carried along
  if (!end || !scene.problem().ties.empty()) return;
  for (const fem::Dof dof : {fem::Dof::u1, fem::Dof::u2}) {
    double least = HUGE_VAL, largest = -HUGE_VAL;
    int count = 0;
    for (const std::optional<double>& given : given_at(scene.problem(), dof, *end)) {
      if (!given) continue;
      ++count;
      least = std::min(least, *given);
      largest = std::max(largest, *given);
    }
    const double size = std::max(std::abs(least), std::abs(largest));
    const fem::PrescribedDof<2>* const item = first_that_moves(scene, dof);
    if (count < 2 || item == nullptr || size == 0.0 || largest - least > kAlike * size) continue;
    const int axis = dof == fem::Dof::u1 ? 1 : 2;
    const coupler::Entry* const value = scene.boundary_value(item->on, "move");
    remarks.push_back(
        {Rank::wrong, 10.0,
         (value != nullptr ? *value : scene.place({"boundary"}))
             .fault(fmt::format(
                 "boundary: all that is given along {} moves by {}: the body is carried along, and not strained",
                 axis, metres(largest))),
         fmt::format("hold the opposite boundary with 'fix: [u{}]', or move it the other way", axis)});
  }
}

}  // namespace polargrain::app
