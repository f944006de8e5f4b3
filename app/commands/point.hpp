// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "common/increment.hpp"
#include "grains_io/script.hpp"

namespace polargrain::app {

struct PointOptions {
  std::filesystem::path case_file;
  std::string material;
  std::filesystem::path path_file;
  std::filesystem::path output;  ///< empty: standard output
  std::filesystem::path replay;  ///< when given, gets the path as a script for polargrain-liggghts
  std::vector<std::string> settings;
  ScriptRules scripts = {};
};

/// Reads a path: a line of column names out of h11,h12,h21,h22,w,k1,k2 in any order (columns left out are
/// zero), then an increment a line. Lines that start with '#' and empty ones are skipped.
/// @throws InputError with all faults
std::vector<Increment<2>> read_path(const std::filesystem::path& file);

/// Takes one point of a material of a case along a path and writes its answers (docs/file_formats.md). An
/// answer that is not good is written with its status; after a failed one the path ends. A replay is written
/// before the path is followed, so that it is there whatever happens, and again with the answers after it.
/// @throws InputError when the material has no cell to replay
/// @returns 0, or 1 when an increment failed
int point(const PointOptions& options);

}  // namespace polargrain::app
