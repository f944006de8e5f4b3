// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>

namespace polargrain::app {

/// The status of a run in the summary of its result: done, failed or stopped. Empty without a summary that can be read: the run is at
/// work, or was ended from outside.
std::string status_of_run(const std::filesystem::path& directory);

}  // namespace polargrain::app
