// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>

namespace polargrain::coupler {

/// Where a run writes when it is not told: results/NAME in the current directory, NAME being the case file's
/// name without its ending, or that of its folder when the file is called case.yaml.
std::filesystem::path default_result_directory(const std::filesystem::path& case_file);

/// Makes the directory, or empties it of the files of a former run. Anything else in it stays.
/// @throws InputError when it exists, is not empty and holds no former result (summary.json or run.log):
/// nothing of the user's own is ever mixed with results. RunError when it cannot be made or written.
void prepare_result_directory(const std::filesystem::path& directory);

}  // namespace polargrain::coupler
