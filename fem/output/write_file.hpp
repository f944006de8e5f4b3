// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>

namespace polargrain::fem {

/// Writes a file beside its final place and renames it, so that readers see it complete or not at all.
/// @throws RunError when it cannot be written.
void write_file(const std::filesystem::path& file, const std::string& content);

}  // namespace polargrain::fem
