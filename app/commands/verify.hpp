// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>

#include "grains_io/script.hpp"

namespace polargrain::app {

struct VerifyOptions {
  std::filesystem::path directory;  ///< of a run's results
  int workers = 1;
  ScriptRules scripts = {};
};

/// Holds a result against its own proof (docs/file_formats.md, summary.json): that its files are those the run wrote, the
/// summary included, that the case and its files are still those it was run from, and that the cells of its sample, evaluated
/// again from their states, answer with the same bits. Says what it finds, line by line, and which files are under no proof.
/// Finds mistakes and careless changes; whoever means to deceive can compute the names anew, but not the answers of cells.
/// @returns 0 when all agrees, 1 when something does not
/// @throws InputError when the directory holds no proof or the case is not there; RunError
int verify(const VerifyOptions& options);

}  // namespace polargrain::app
