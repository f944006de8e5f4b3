// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// A case of a text, read with a piece of it replaced: what it means, and the faults of what is wrong in it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "coupler/case/case.hpp"

namespace polargrain::testing {

class EditedCase : public ::testing::Test {
 protected:
  /// @param name of a folder of this process, which the case lies in
  EditedCase(const std::string& name, std::string text)
      : directory_(std::filesystem::temp_directory_path() / (name + "." + std::to_string(getpid()))),
        text_(std::move(text)) {
    std::filesystem::create_directories(directory_);
  }
  ~EditedCase() override { std::filesystem::remove_all(directory_); }

  /// The case with a piece of its text replaced.
  [[nodiscard]] coupler::Case read(const std::string& good = "", const std::string& bad = "") const {
    std::string text = text_;
    if (!good.empty()) text.replace(text.find(good), good.size(), bad);
    std::ofstream(directory_ / "case.yaml") << text;
    return coupler::read_case(directory_ / "case.yaml");
  }
  /// Its faults. Empty: it has none.
  [[nodiscard]] std::vector<Fault> faults(const std::string& good = "", const std::string& bad = "") const {
    try {
      (void)read(good, bad);
    } catch (const InputError& error) {
      return error.faults();
    }
    return {};
  }
  /// "LINE: message" of the first fault, or "no fault".
  [[nodiscard]] std::string fault(const std::string& good = "", const std::string& bad = "") const {
    const std::vector<Fault> found = faults(good, bad);
    return found.empty() ? "no fault" : std::to_string(found.front().line) + ": " + found.front().message;
  }
  [[nodiscard]] const std::filesystem::path& directory() const { return directory_; }

 private:
  std::filesystem::path directory_;
  std::string text_;
};

}  // namespace polargrain::testing
