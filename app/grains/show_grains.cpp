// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/grains/show_grains.hpp"

#include <fmt/format.h>

#include "app/commands/in_child.hpp"
#include "app/grains/grain_replay.hpp"
#include "common/error.hpp"
#include "coupler/pool/log_excerpt.hpp"

namespace polargrain::app {

void show_grains(const ShownGrains& what,
                 const std::function<void(std::size_t point, int step, const GrainView&)>& see) {
  const CellPaths::Ways ways = what.paths.ways(what.points, what.steps);
  const auto make = [&](const CellDefinition& cell) {
    return make_checked_service(cell, what.scripts, what.engine);
  };
  const auto work = [&](ProgressLine& progress) {
    what.engine.start_process();
    for (std::size_t k = 0; k < what.points.size(); ++k) {
      GrainReplay replay(*what.paths.cell(what.points[k]), make, ways);
      for (const auto& [step, states] : ways.states) {
        see(what.points[k], step, replay.view(states[k]));
        progress.say(fmt::format("point {}: step {}", what.points[k], step));
      }
    }
  };
  if (!run_in_child(what.log, work, what.shows_progress))
    throw RunError(fmt::format("the grains cannot be shown (the engine's output is in {}):\n{}",
                               what.log.string(), coupler::log_excerpt(what.log)));
}

}  // namespace polargrain::app
