// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/csv_table.hpp"
#include "tests/faults/checkpoint_runs.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {

/// What differs between the columns of ColumnRun; keys of a case.
struct Column {
  std::string steps;
  std::string model = "cell";
  std::string material = "lc: 50 mm";
  std::string deformation = "large";
};

/// Runs of the program on a column of 2 x 4 elements of 100 discs between rough plates, compressed by 1 % in ten steps. A test's
/// directory holds case.yaml, the packing and the results.
class ColumnRun : public ::testing::Test {
 protected:
  ColumnRun() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    const std::filesystem::path source = POLARGRAIN_SOURCE_DIRECTORY;
    std::filesystem::copy(source / "cases/footing_cells/packing100.h5", scratch_.path());
  }

  void write_column(const Column& column) const {
    write(scratch_.path() / "case.yaml",
          "title: A column\n"
          "mesh: {rectangle: {size: [0.1 m, 0.2 m], elements: [2, 4]}}\n"
          "deformation: " +
              column.deformation + "\nmaterials:\n  sand: {model: " + column.model +
              ", script: cells/hooke_li_chu.in, packing: packing100.h5, " + column.material +
              "}\n"
              "regions: {all: sand}\n"
              "boundary:\n"
              "  - {on: bottom, fix: [u1, u2]}\n"
              "  - {on: top, fix: [u1], move: {u2: -2 mm}}\n"
              "  - {on: [left, right], pressure: 100 kPa}\n"
              "steps: {count: 10, " +
              column.steps +
              "}\n"
              "monitors:\n"
              "  top_force: {on: top, reaction: u2}\n"
              "  bottom_force: {on: bottom, reaction: u2}\n");
  }
  [[nodiscard]] Outcome run(const std::string& name, const std::string& options = "--quiet") const {
    return run_in(scratch_.path(), POLARGRAIN " run case.yaml -o " + name + " " + options);
  }
  [[nodiscard]] std::vector<double> column(const std::string& name, const std::string& of) const {
    return CsvTable(scratch_.path() / name / "history.csv").numbers(of);
  }
  [[nodiscard]] nlohmann::json summary(const std::string& name) const {
    return nlohmann::json::parse(content(scratch_.path() / name / "summary.json"));
  }
  /// Kills runs of case.yaml at moments drawn from `seed`; those that go on must come to the same bytes (kill_again_and_again).
  void expect_the_same_behind_kills(const std::string& expected, int times, unsigned seed,
                                    const std::string& what) const {
    const auto check = [&](int status, const std::filesystem::path& result) {
      EXPECT_EQ(status, 0) << content(scratch_.path() / "program.out");
      EXPECT_TRUE(results_of(result) == expected) << what;
      std::filesystem::remove_all(result);
    };
    const Kills done = kill_again_and_again(scratch_.path(), "run case.yaml --quiet", times, seed, check);
    std::cout << "[figure] " << what << ": " << done.kills << " runs killed, " << done.resumed
              << " resumed\n";
  }

  Scratch scratch_;
};

}  // namespace polargrain::testing
