// SPDX-License-Identifier: GPL-2.0-or-later
// Ground with weight between sides that hold it up.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/remarks/kinds.hpp"

namespace polargrain::app {
namespace {

/// Names of the boundaries, a vertical one at each end of the body, that fix u2 along all of it.
std::vector<std::string> sides_that_hold(const Scene& scene) {
  const auto held = held_nodes(scene.problem());
  const double slack = 1e-6 * scene.body().size().x();
  std::vector<std::string> found;
  for (const double end : {scene.body().least.x(), scene.body().largest.x()}) {
    for (const auto& [name, edges] : scene.mesh().boundaries) {
      const std::vector<OutlineEdge> along = edges_of(scene.mesh(), name);
      const bool is_side = !along.empty() && std::ranges::all_of(along, [&](const OutlineEdge& edge) {
        return std::abs(edge.centre.x() - end) < slack && std::abs(edge.normal.x()) > 0.999;
      });
      if (!is_side || !held_along(along, held).all[1]) continue;
      found.push_back(name);
      break;
    }
  }
  return found;
}

}  // namespace

void held_sides(const Scene& scene, Remarks& remarks) {
  const bool heavy = std::ranges::any_of(scene.problem().body_loads, [&](const fem::BodyLoad<2>& load) {
    return load.density(scene.body().least).y() < 0.0;
  });
  if (!heavy) return;
  const std::vector<std::string> sides = sides_that_hold(scene);
  if (sides.size() < 2) return;
  const double width = scene.body().size().x();
  const double height = scene.body().size().y();
  const coupler::Entry* const value = scene.boundary_value(sides[0], "fix");
  remarks.push_back(
      {Rank::doubtful, std::max(1.0, height / width),
       (value != nullptr ? *value : scene.place({"boundary"}))
           .fault(fmt::format(
               "boundary: u2 is fixed along '{}' and '{}': the ground between them hangs on its sides, as in "
               "a silo {:.3g} m wide and {:.3g} m high",
               sides[0], sides[1], width, height)),
       "ground that goes on beyond the mesh slides there: fix: [u1]"});
}

}  // namespace polargrain::app
