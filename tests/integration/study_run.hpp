// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "tests/integration/command.hpp"

namespace polargrain::testing {

/// The command line of cases/studies/biaxial.py with the programs of this build, results in `out`.
inline std::string study(const std::string& options) {
  const auto folder = [](const char* program) {
    return std::filesystem::path(program).parent_path().string();
  };
  return fmt::format("PYTHONPATH={} {} {} -o out {} --programs {} {}", PYTHON_PACKAGE, PYTHON, STUDY, options,
                     folder(POLARGRAIN), folder(POLARGRAIN_LIGGGHTS));
}

}  // namespace polargrain::testing
