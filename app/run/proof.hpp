// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace polargrain::app {

/// The file with a run's sample of answers, in its result directory.
constexpr const char* kSampleFile = "sample.h5";

/// Names (XXH3, 128 bits, 32 hexadecimal digits) of what a run has come to: history.csv, fields.pvd, points.pvd, all of fields/ as one,
/// the sample; of those that are there.
std::map<std::string, std::string> names_of_results(const std::filesystem::path& directory);

/// The name of a file's content; empty when it cannot be read.
std::string name_of_file(const std::filesystem::path& file);

}  // namespace polargrain::app
