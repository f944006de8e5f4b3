// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/commands/pack.hpp"
#include "app/commands/worker.hpp"
#include "coupler/case/document_kind.hpp"

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

// ---- outputs

/// The files that a case or a specification is read with (coupler::files_named_in), itself the first.
/// @throws InputError as coupler::load_document_of
std::vector<std::filesystem::path> files_read_with(coupler::DocumentKind kind,
                                                   const std::filesystem::path& file,
                                                   const std::vector<std::string>& settings);
/// Refuses a file that cannot be written or that is one of `inputs`, before the command works.
/// @param option "-o", for the message @param output empty: the command writes nothing @throws InputError
void check_output(const std::string& option, const std::filesystem::path& output,
                  const std::vector<std::filesystem::path>& inputs);

/// The same of a page: it takes the place of an older page alone.
void check_page(const std::string& option, const std::filesystem::path& output,
                const std::vector<std::filesystem::path>& inputs);

/// The same of a table that takes the place of an older one alone, beside a file that was named.
/// @param beginning of its column names
void check_table(const std::string& option, const std::filesystem::path& output,
                 const std::vector<std::filesystem::path>& inputs, const std::string& beginning);
/// Refuses the places of files of a run (is_of_a_run). @param option as above @throws InputError
void check_beside_run(const std::string& option, const std::filesystem::path& output,
                      const std::filesystem::path& directory);

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
