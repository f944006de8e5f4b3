// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "common/csv_table.hpp"
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

}  // namespace polargrain::testing
