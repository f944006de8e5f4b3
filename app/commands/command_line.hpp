// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <set>
#include <string>

#include "common/cell.hpp"
#include "common/state_check.hpp"
#include "app/commands/pack.hpp"

namespace polargrain::app {

/// What a worker runs; given by the program, so that the coupler knows no engine.
struct WorkerEngine {
  /// Called once, before anything else, in a process that becomes a worker.
  std::function<void()> start_process;
  CellServiceFactory make_service;
  /// Commands of scripts that it understands beside LIGGGHTS's own and that can do no harm.
  std::set<std::string> script_commands = {};
  /// Judges the states that workers send; may be empty.
  StateCheck state_fault = {};
};

/// The whole program: reads the command line, does what it says.
/// @returns the exit status: 0 done, 1 the run failed, 2 the input or the command line is wrong, 3 stopped by
/// a signal
int command_line(int count, char** arguments, const WorkerEngine& engine, const PackingTools& packing_tools);

}  // namespace polargrain::app
