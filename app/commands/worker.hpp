// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "common/cell.hpp"
#include "common/state_check.hpp"
#include "coupler/pool/worker.hpp"
#include "grains_io/script.hpp"

namespace polargrain::app {

/// The engine that a worker runs; given by the program, so that the coupler knows no engine.
struct WorkerEngine {
  /// Called once, before anything else, in a process that becomes a worker.
  std::function<void()> start_process;
  CellServiceFactory make_service;
  /// Commands of scripts that it understands beside LIGGGHTS's own and that can do no harm.
  std::set<std::string> script_commands = {};
  /// Judges the states that workers send; may be empty.
  StateCheck state_fault = {};
};

/// Makes an engine for a script that may be run here: who starts the process says which, not who sent the definition.
/// @throws RunError when it may not
std::unique_ptr<CellService> make_checked_service(const CellDefinition& definition, const ScriptRules& rules,
                                                  const WorkerEngine& engine);

struct WorkerOptions {
  std::string url;  ///< of the coordinator
  std::string log;  ///< file for all output; empty: the terminal
  std::string key;  ///< file of the key, for tcp://; empty: no key
  double patience_seconds = coupler::ServeOptions{}.patience_seconds;  ///< without a coordinator
  ScriptRules scripts = {};  ///< which scripts it runs, whatever its coordinator says
};

/// Works for a coordinator until that ends or is gone for too long. Unless its scripts are trusted it first gives up rights
/// that it does not need (coupler/pool/confinement.hpp). @returns the exit status, 0 or 1
/// @throws InputError when the key or the log cannot be used
int work(const WorkerOptions& options, const WorkerEngine& engine);

}  // namespace polargrain::app
