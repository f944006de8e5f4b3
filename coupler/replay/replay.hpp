// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "common/cell.hpp"

namespace polargrain::coupler {

/// A way of one cell, to be gone again outside of any coupling.
struct Replay {
  StatePointer start;                     ///< null: the packing at rest
  std::vector<CellIncrement> increments;  ///< one after the other
  /// The cell's answers, one an increment from the first on; as many as there are, for comparison.
  std::vector<CellResponse> answers;
  std::string reason;  ///< why it is written, a sentence for its README
};

/// Writes a folder that `polargrain-liggghts -in in.replay` runs in, without anything outside of it: the
/// packing, the state, the user's script, the script that drives the cell, and a README with the command and
/// the stresses to expect. The run takes the same DEM steps as the cell did, to the bit. The folder is made
/// when missing; files of an earlier replay in it are replaced.
/// @throws RunError when a file cannot be written.
void write_replay(const std::filesystem::path& directory, const CellDefinition& definition,
                  const Replay& replay);

/// The same for one request, for instance one that was never answered.
/// @param reason a sentence for the README
void write_replay(const std::filesystem::path& directory, const CellDefinition& definition,
                  const CellRequest& request, const std::string& reason);

}  // namespace polargrain::coupler
