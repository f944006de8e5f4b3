// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <span>
#include <string_view>

namespace polargrain {

enum class Durability {
  system,  ///< handed to the system: survives the end of the program
  disk     ///< on the disk, with all that was written before on its file system: survives that of the machine
};

/// Writes a file beside its final place and renames it, so that readers see it complete or not at all, and
/// whatever happens it is the former one or the new one. A link is followed. Into a target that is
/// not a file (/dev/stdout, a pipe) the bytes are written as they are: nothing takes its place.
/// @param keep where the former file goes when the new one is there; empty: it is not kept
/// @throws RunError with the reason when it cannot be written; a former one is then untouched
void write_file(const std::filesystem::path& file, std::string_view content,
                Durability durability = Durability::system, const std::filesystem::path& keep = {});
/// The same of several parts, one behind the other.
void write_file(const std::filesystem::path& file, std::span<const std::string_view> parts,
                Durability durability = Durability::system, const std::filesystem::path& keep = {});

}  // namespace polargrain
