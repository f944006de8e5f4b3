// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "coupler/cells/resident_cells.hpp"
#include "tests/unit/resident_service.hpp"

namespace polargrain::coupler {

/// Pools of workers around LineService.
class ResidentTest : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() /
                 (std::string("polargrain_") +
                  ::testing::UnitTest::GetInstance()->current_test_info()->name() + std::to_string(getpid()));
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  [[nodiscard]] PoolOptions options(int workers) {
    PoolOptions options;
    options.workers = workers;
    options.directory = directory_;
    options.worker_command = {RESIDENT_WORKER};
    options.tell = [this](const std::string& text) { told_.push_back(text); };
    return options;
  }
  /// The script, whose processes end once where it says so.
  [[nodiscard]] std::string ends_once(const std::string& script) {
    return script + " mark " + (directory_ / ("mark" + std::to_string(++marks_))).string();
  }

  std::filesystem::path directory_;
  std::vector<std::string> told_;
  int marks_ = 0;
};

}  // namespace polargrain::coupler
