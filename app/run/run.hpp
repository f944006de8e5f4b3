// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/state_check.hpp"
#include "grains_io/script.hpp"

namespace polargrain::app {

struct RunOptions {
  std::filesystem::path case_file;
  std::filesystem::path directory;  ///< empty: default_result_directory
  int workers = 1;
  bool resume = false;                       ///< go on from the checkpoint in the directory
  std::optional<double> checkpoint_minutes;  ///< in place of the case's own
  bool quiet = false;
  bool strict = false;         ///< remarks on the case are faults
  std::string listen;          ///< tcp://HOST:PORT where workers of other machines may join; empty: no guest
  std::filesystem::path keys;  ///< directory of 'polargrain keys', needed to listen
  std::vector<std::string> settings;  ///< of --set
  ScriptRules scripts = {};           ///< which scripts of cells are run
  StateCheck state_fault = {};        ///< see PoolOptions
};

/// Runs a case from its start, or from a checkpoint, to its end and writes the result directory
/// (docs/file_formats.md). Input is checked whole before anything is written or started.
/// @returns 0 when the last step is committed, 1 when a step did not converge
/// @throws InputError, RunError, Interrupted; after the last two the committed steps are in the result
/// directory, with a checkpoint to go on from
int run(const RunOptions& options);

}  // namespace polargrain::app
