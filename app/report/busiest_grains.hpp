// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "app/commands/worker.hpp"
#include "app/report/run_result.hpp"

namespace polargrain::app {

/// The grains of a point of the element that has sheared most at the end, there and at the start, made again from what the run
/// has kept. @returns HTML: two figures, or why there are no figures; empty for a run without cells, or that is still at work
std::string busiest_grains(const RunResult& result, const ScriptRules& scripts, const WorkerEngine& engine);

}  // namespace polargrain::app
