// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

namespace polargrain::coupler {

/// The end of a dead worker's log: the last lines that contain "ERROR", as LIGGGHTS writes them,
/// or in their absence the last lines. Reads no more than the last 64 kB;
/// lines come as plain text (common/plain_text.hpp).
/// @param from where in the file to begin: lines of earlier processes are of no interest
/// @returns at most `most_lines` lines, each ended by '\n'; empty when the log is empty or cannot be read.
std::string log_excerpt(const std::filesystem::path& log, std::uintmax_t from = 0,
                        std::size_t most_lines = 5);

}  // namespace polargrain::coupler
