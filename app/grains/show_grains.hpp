// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>

#include "app/commands/worker.hpp"
#include "app/grains/cell_paths.hpp"
#include "common/grain_view.hpp"

namespace polargrain::app {

/// Which grains of a run are to be seen, and who makes them.
struct ShownGrains {
  const CellPaths& paths;
  const std::vector<std::size_t>& points;  ///< with cells
  const std::set<int>& steps;              ///< of paths.steps()
  const ScriptRules& scripts;
  const WorkerEngine& engine;
  const std::filesystem::path& log;  ///< takes the output of the engine; kept when it goes wrong
  bool shows_progress = false;
};

/// Makes the grains of points again, point after point, step after step, in a process of its own that has an engine.
/// @param see called there: its results must be files
/// @throws InputError as CellPaths::ways; RunError in the engine's words
void show_grains(const ShownGrains& what,
                 const std::function<void(std::size_t point, int step, const GrainView&)>& see);

}  // namespace polargrain::app
