// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>

#include "common/memory_archive.hpp"
#include "common/write_file.hpp"
#include "coupler/case/case_identity.hpp"

namespace polargrain::coupler {

/// A run after one of its steps: all that is needed to go on, and everything it had written up to then.
struct Checkpoint {
  std::string program;  ///< version that wrote it
  CaseIdentity identity;
  int step = 0;         ///< the last step taken
  std::string history;  ///< history.csv up to that step
  std::string costs;    ///< costs.csv up to that step
  MemoryArchive state;  ///< of the solver and the materials
};

/// Where the checkpoint before the one in `file` is kept: `checkpoint.before.h5` beside `checkpoint.h5`.
std::filesystem::path checkpoint_before(const std::filesystem::path& file);

/// Writes a checkpoint beside its final place, brings it to the disk and puts it in place: whatever happens,
/// `file` is the former one or the new one, whole; behind it the former one is `checkpoint_before`. States are
/// stored once by their content.
/// @param durability `system`: it comes to the disk when the system, or the next checkpoint, brings it there
/// @throws RunError when it cannot be written; a former one is then untouched
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint,
                      Durability durability = Durability::disk);

/// @throws InputError when it is missing, damaged, truncated, or of another version; it names
/// the one before when that can be read
Checkpoint read_checkpoint(const std::filesystem::path& file);

}  // namespace polargrain::coupler
