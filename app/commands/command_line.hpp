// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "app/commands/pack.hpp"
#include "app/commands/worker.hpp"

namespace polargrain::app {

/// The whole program: reads the command line, does what it says.
/// @returns the exit status: 0 done, 1 the run failed, 2 the input or the command line is wrong, 3 stopped by
/// a signal
int command_line(int count, char** arguments, const WorkerEngine& engine, const PackingTools& packing_tools);

}  // namespace polargrain::app
