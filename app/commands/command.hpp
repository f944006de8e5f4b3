// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "app/commands/pack.hpp"
#include "app/commands/worker.hpp"

namespace polargrain::app {

/// The services that commands need from the grains' side; given by the program, so that nothing here knows an engine.
struct Grains {
  const WorkerEngine& engine;
  const PackingTools& packing_tools;
};

/// A command as the command line has it: its options and help, and what it does once they are read.
struct Command {
  CLI::App* options = nullptr;
  std::function<int()> call;  ///< @returns the exit status
  /// Whether its output is the answer asked for, so that standard output must take it, or only a comfort.
  bool is_answer = true;
};

// ---- options shared by several commands

/// A case or specification as named; where that file does not exist, the program's own example of that name
/// (cases/): the examples of --help work in any folder.
std::string brought_along(const std::string& name);
/// CASE, which must be given.
void add_case(CLI::App& command, std::filesystem::path& file);
/// --set KEY=VALUE
void add_settings(CLI::App& command, std::vector<std::string>& settings);
/// --strict
void add_strict(CLI::App& command, bool& strict);
/// --trust-scripts. @param rules of the command, which also get the words that the engine understands
void add_trust(CLI::App& command, ScriptRules& rules, const Grains& grains);
/// For options that are numbers, beside their bounds: nan lies within any bounds, and nothing can be done infinitely.
CLI::Validator finite_number();
/// -w,--workers; one a core where it is not given. @param least may be 0 where others may join
void add_workers(CLI::App& command, int& workers, int least);

}  // namespace polargrain::app
