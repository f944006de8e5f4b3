// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/start_text.hpp"

#include <fmt/format.h>

namespace polargrain::app {

std::string text_of(const fem::StartReport& start) {
  std::string text =
      start.same_mesh
          ? "  the mesh is the same: points keep their states"
          : "  another mesh: displacements come by the shape functions of the old elements, states of "
            "laws by linear functions around their nodes";
  if (start.from_nearest > 0)
    text += fmt::format("\n  {} boxes of grains are those of the nearest old point, at most {:.3g} m away",
                        start.from_nearest, start.farthest);
  if (start.zeroed > 0)
    text += fmt::format(
        "\n  {} values of states were set to zero: the function around them had a sign that no old point has",
        start.zeroed);
  text += fmt::format(
      "\n  out of balance by {:.3g} of the loads; balance was found by a movement of at most {:.3g} m",
      start.imbalance, start.moved);
  return text;
}

}  // namespace polargrain::app
