// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace polargrain {

/// Why an input file cannot be opened and read, in words that follow its name; empty when it can. Pipes and devices are refused:
/// who opens a pipe that nobody writes to waits for ever. Links are followed.
std::string why_no_input(const std::filesystem::path& file);

/// Why write_file() could not write a file, in words that follow its name; empty when nothing is known that hinders it. For work
/// that takes hours and writes at its end.
std::string why_no_output(const std::filesystem::path& file);

/// Why a command must not write a file, in words that follow its name: it is one of the files that the command reads, whatever
/// names and links lead to it. Another file gives an empty text. @param inputs may name files that do not exist
std::string why_not_over(const std::filesystem::path& output,
                         const std::vector<std::filesystem::path>& inputs);

/// Why a command must not write a file, in words that follow its name: something else is there than the command writes. Empty
/// where nothing is, or a device. @param beginning of all that it writes there @param what that is: "page of polargrain"
std::string why_not_own(const std::filesystem::path& file, std::string_view beginning, std::string_view what);

}  // namespace polargrain
