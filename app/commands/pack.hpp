// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/cell.hpp"
#include "common/packing_specification.hpp"
#include "grains_io/script.hpp"

namespace polargrain::app {

/// The services that packings need from the grains' side; given by the program, so that the coupler knows no engine.
struct PackingTools {
  /// Called once in the process that makes the packing.
  std::function<void()> start_process;
  PackingMaker make;
  PackingSettler settle = {};  ///< empty where no packing is ever settled
  /// LIGGGHTS with a command line of its own (program first), in a process of its own. @returns its exit status
  std::function<int(const std::vector<std::string>&)> run_script = {};
};

struct PackOptions {
  std::filesystem::path specification_file;
  std::filesystem::path output;  ///< ends in .h5
  std::filesystem::path
      export_file;  ///< when given, `specification_file` is a packing that is written there as text
  std::vector<std::string> settings;
  bool quiet = false;
  /// A packing and the script that it is brought to rest under, as it is; or nothing.
  std::vector<std::filesystem::path> settle = {};
  ScriptRules scripts = {};
  /// Further remarks on a plane packing at the end, on the cell that it makes under its script; empty: no remarks.
  std::function<std::string(const CellDefinition&)> moduli = {};
};

/// Makes a packing, telling how far it is.
using PackingWork = std::function<PreparedPacking(const std::function<void(const PackingReached&)>&)>;

/// Does such work in a process of its own (an engine error ends its process), whose whole output goes to a log beside the
/// packing; the log is removed when all went well. @param output is written whole or not at all
/// @returns which loop has stepped the grains, in words (kSteppingNote) @throws RunError in the engine's words
std::string make_packing_file(const PackingWork& make, const std::filesystem::path& output,
                              const PackingTools& tools, bool quiet);

/// Makes a packing after a specification, in a process of its own (an engine error ends its process), whose
/// whole output goes to a log beside the packing. The log is removed when all went well.
/// @throws RunError in the engine's words
int pack(const PackOptions& options, const PackingTools& tools);

}  // namespace polargrain::app
