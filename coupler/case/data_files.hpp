// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace polargrain::coupler {

/// Where a file named in a case may lie, in the order of trial: beside the case; then, for files that the program
/// brings along (liggghts_inputs/, cases/), in $POLARGRAIN_DATA and in ../share/polargrain of the program.
std::vector<std::filesystem::path> data_places(const std::filesystem::path& case_directory);

/// The first existing file; a name such as cells/hooke_radii.in is also tried below liggghts_inputs/.
std::optional<std::filesystem::path> find_data_file(const std::string& name,
                                                    const std::filesystem::path& case_directory);

/// The bytes of a file; empty when it cannot be read.
std::string content_of(const std::filesystem::path& file);

}  // namespace polargrain::coupler
