// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/layer/wall_row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"

namespace polargrain::app {

OnWall on_wall(const Packing& packing, double diameter, double height) {
  const double width = packing.box.col(0).norm();
  OnWall made;
  made.grains = packing;
  made.grains.state = {};
  std::erase_if(made.grains.grains, [height](const Grain& grain) { return grain.position.y() > height; });
  made.top = std::min(height, packing.box.determinant() / width);
  made.grains.box.col(1) = Eigen::Vector2d(0.0, made.top);
  const auto count = static_cast<int>(std::lround(width / diameter));
  if (count < 3 || made.grains.grains.empty())
    throw RunError(
        fmt::format("a wall of grains of {:.3g} m does not fit below a packing that is {:.3g} m wide; take "
                    "more grains or less roughness",
                    diameter, width));
  const double pitch = width / count;
  made.radius = 0.5 * pitch;
  made.wall = HUGE_VAL;
  double mass = 0.0;
  for (const Grain& grain : made.grains.grains) {
    mass += grain.mass / static_cast<double>(made.grains.grains.size());
    // The row is periodic: the nearest of its grains on either side bound the height from above.
    const double reach = grain.radius + made.radius;
    const double from_left = grain.position.x() - pitch * std::floor(grain.position.x() / pitch);
    for (double away = -from_left; away < reach; away += pitch)
      if (std::abs(away) < reach)
        made.wall = std::min(made.wall, grain.position.y() - std::sqrt(reach * reach - away * away));
    for (double away = -from_left - pitch; away > -reach; away -= pitch)
      made.wall = std::min(made.wall, grain.position.y() - std::sqrt(reach * reach - away * away));
  }
  std::int64_t last = 0;
  for (const Grain& grain : packing.grains) last = std::max(last, grain.id);
  const double own = mass * std::max(1.0, std::pow(made.radius / packing.mean_radius(), 2));
  for (int k = 0; k < count; ++k)
    made.grains.grains.push_back({.id = last + 1 + k,
                                  .position = {pitch * k, made.wall},
                                  .radius = made.radius,
                                  .mass = own,
                                  .moment_of_inertia = 0.5 * own * made.radius * made.radius});
  return made;
}

}  // namespace polargrain::app
