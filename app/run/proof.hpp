// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace polargrain::app {

/// The file with a run's sample of answers, in its result directory.
constexpr const char* kSampleFile = "sample.h5";

/// Names (XXH3, 128 bits, 32 hexadecimal digits) of the results of a run, by file or folder, a folder as one; of those that are
/// there: history.csv, costs.csv, run.log, fields.pvd, points.pvd, fields, cell_paths, the sample, the checkpoint. To be asked
/// for when all of them are written, the log included.
/// @throws RunError when one that is there cannot be read
std::map<std::string, std::string> names_of_results(const std::filesystem::path& directory);

/// The entries of a result directory without a proof, because commands and users change them after the run: of those that are
/// there.
std::vector<std::string> without_proof(const std::filesystem::path& directory);

/// The name of a file's content; empty when it cannot be read.
std::string name_of_file(const std::filesystem::path& file);

/// The name of all that a summary says, except of that name itself (proof: summary): of its keys in the order of the alphabet,
/// so that neither blanks nor the order of keys matter.
std::string name_of_summary(const nlohmann::ordered_json& summary);

}  // namespace polargrain::app
