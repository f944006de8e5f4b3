// SPDX-License-Identifier: GPL-2.0-or-later
// Explicit steps with resident boxes by the whole program: near Newton's method, and the same bytes whoever has the boxes,
// whoever dies, and wherever the run is broken off.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "common/csv_table.hpp"
#include "tests/faults/checkpoint_runs.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::filesystem::path kSource = POLARGRAIN_SOURCE_DIRECTORY;

class ExplicitRunTest : public ::testing::Test {
 protected:
  ExplicitRunTest() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::copy(kSource / "cases/footing_cells/packing100.h5", scratch_.path());
  }

  /// A column between rough plates, compressed by 1 % in ten rows of explicit steps.
  void write_case(const std::string& steps, const std::string& material = "lc: 50 mm") const {
    write(scratch_.path() / "case.yaml",
          "title: A column in explicit steps\n"
          "mesh: {rectangle: {size: [0.1 m, 0.2 m], elements: [2, 4]}}\n"
          "deformation: large\n"
          "materials:\n  sand: {model: cell, script: cells/hooke_li_chu.in, packing: packing100.h5, " +
              material +
              "}\n"
              "regions: {all: sand}\n"
              "boundary:\n"
              "  - {on: bottom, fix: [u1, u2]}\n"
              "  - {on: top, fix: [u1], move: {u2: -2 mm}}\n"
              "  - {on: [left, right], pressure: 100 kPa}\n"
              "steps: {count: 10, " +
              steps +
              "}\n"
              "monitors:\n"
              "  top_force: {on: top, reaction: u2}\n"
              "  bottom_force: {on: bottom, reaction: u2}\n");
  }
  [[nodiscard]] std::vector<double> forces_of(const std::string& name) const {
    const CsvTable history(scratch_.path() / name / "history.csv");
    std::vector<double> mean = history.numbers("top_force");
    const std::vector<double> below = history.numbers("bottom_force");
    for (std::size_t row = 0; row < mean.size(); ++row) mean[row] = 0.5 * (mean[row] - below[row]);
    return mean;
  }

  Scratch scratch_;
};

// Two careful runs of Newton's method differ by 0.2 % before the peak; a packing of 100 grains is no smooth material.
TEST_F(ExplicitRunTest, StaysNearNewtonsMethod) {
  write_case("tolerance: 1e-2");
  const Outcome newton = run_in(scratch_.path(), POLARGRAIN " run case.yaml --quiet -w 2 -o newton");
  ASSERT_EQ(newton.status, 0) << newton.errors;
  write_case("method: explicit");
  const Outcome outcome = run_in(scratch_.path(), POLARGRAIN " run case.yaml --quiet -w 2 -o explicit");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const std::vector<double> expected = forces_of("newton");
  const std::vector<double> found = forces_of("explicit");
  ASSERT_EQ(expected.size(), found.size());
  double sum = 0.0;
  for (std::size_t row = 0; row < found.size(); ++row)
    sum += std::pow(found[row] / expected.back() - expected[row] / expected.back(), 2);
  const double rms = std::sqrt(sum / static_cast<double>(found.size()));
  std::cout << "[figure] rms of the difference to Newton's method, of the last force: " << rms << '\n';
  EXPECT_LT(rms, 0.02);
}

TEST_F(ExplicitRunTest, WorkersKillsAndResumptionsChangeNoByte) {
  for (const char* const material : {"lc: 50 mm", "rotations: controlled"}) {
    write_case("method: explicit, pace: 4e-4", material);
    const std::string run = "run case.yaml --quiet --checkpoint-minutes 0";
    ASSERT_EQ(run_in(scratch_.path(), POLARGRAIN " " + run + " -w 1 -o one").status, 0) << material;
    const std::string expected = results_of(scratch_.path() / "one");
    RunningProgram disturbed(scratch_.path(), run + " -w 3 -o three");
    const int kills = kill_workers(disturbed, scratch_.path() / "three" / "history.csv", 3, 1.0, 20261124);
    EXPECT_EQ(disturbed.wait(), 0) << content(scratch_.path() / "program.out");
    EXPECT_TRUE(results_of(scratch_.path() / "three") == expected) << material;
    const auto check = [&](int status, const std::filesystem::path& result) {
      EXPECT_EQ(status, 0) << content(scratch_.path() / "program.out");
      EXPECT_TRUE(results_of(result) == expected) << material;
      std::filesystem::remove_all(result);
    };
    const Kills done = kill_again_and_again(scratch_.path(), "run case.yaml --quiet", 3, 20261125, check);
    std::cout << "[figure] " << material << ": " << kills << " workers killed, " << done.kills
              << " runs killed, " << done.resumed << " resumed\n";
    for (const char* const result : {"one", "three"}) std::filesystem::remove_all(scratch_.path() / result);
  }
}

// A mistake in the file is found before a grain moves.
TEST_F(ExplicitRunTest, MistakesAreFaults) {
  const auto errors_of = [&](const std::string& steps, const std::string& material = "lc: 50 mm") {
    write_case(steps, material);
    const Outcome outcome = run_in(scratch_.path(), POLARGRAIN " check case.yaml");
    EXPECT_EQ(outcome.status, 2) << steps;
    return outcome.errors;
  };
  const auto expect_in = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect_in(errors_of("method: explict"), "did you mean 'explicit'?");
  expect_in(errors_of("method: explicit, dem_steps: 1"), "dem_steps");
  expect_in(errors_of("method: explicit, pace: 0.1"), "pace");
  expect_in(errors_of("method: explicit, pace: 1e-4, explicit_steps: 100"), "leave one of them out");
  expect_in(errors_of("pace: 1e-4"), "pace");
}

}  // namespace
}  // namespace polargrain::testing
