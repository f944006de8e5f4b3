// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>

namespace polargrain {

/// Why an input file cannot be opened and read, in words that follow its name; empty when it can. Pipes and devices are refused:
/// who opens a pipe that nobody writes to waits for ever. Links are followed.
std::string why_no_input(const std::filesystem::path& file);

/// Why write_file() could not write a file, in words that follow its name; empty when nothing is known that hinders it. For work
/// that takes hours and writes at its end.
std::string why_no_output(const std::filesystem::path& file);

}  // namespace polargrain
