// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/integration/command.hpp"

namespace polargrain::testing {

/// Runs liggghts_inputs/specimen/specimen.py in a directory, with the programs of this build.
inline Outcome run_specimen(const std::filesystem::path& directory, const std::string& options) {
  const auto folder = [](const char* program) {
    return std::filesystem::path(program).parent_path().string();
  };
  return run_in(directory, fmt::format("python3 {}/specimen.py {} --programs {} {}", SPECIMEN_INPUTS, options,
                                       folder(POLARGRAIN), folder(POLARGRAIN_LIGGGHTS)));
}

/// Rows of history.csv without its head: step, axial strain, stress ratio, volume strain, ...
inline std::vector<std::vector<double>> specimen_history(const std::filesystem::path& file) {
  std::vector<std::vector<double>> rows;
  std::istringstream text(content(file));
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::vector<double>& row = rows.emplace_back();
    for (double value = 0.0; words >> value;) row.push_back(value);
  }
  return rows;
}

}  // namespace polargrain::testing
