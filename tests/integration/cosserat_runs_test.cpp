// SPDX-License-Identifier: GPL-2.0-or-later
// Grains with controlled rotations in all three schemes, by the whole program: how far adaptive and informed runs are
// from the full one, and that workers, kills and resumptions change no byte of theirs.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "common/csv_table.hpp"
#include "tests/faults/checkpoint_runs.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::filesystem::path kSource = POLARGRAIN_SOURCE_DIRECTORY;

/// A column of grains between rough plates that hold the rotations, sheared and compressed: bending next to the plates.
class CosseratRunsTest : public ::testing::Test {
 protected:
  CosseratRunsTest() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::copy(kSource / "cases/footing_cells/packing100.h5", scratch_.path());
  }

  void write_case(const std::string& model) const {
    write(scratch_.path() / "case.yaml",
          "title: A column of grains that control their rotations\n"
          "mesh: {rectangle: {size: [0.1 m, 0.2 m], elements: [2, 4]}}\n"
          "materials:\n  sand: {model: " +
              model +
              ", script: cells/hooke_li_chu.in, packing: packing100.h5, rotations: controlled}\n"
              "regions: {all: sand}\n"
              "boundary:\n"
              "  - {on: bottom, fix: [u1, u2, w]}\n"
              "  - {on: top, fix: [w], move: {u1: 1.2 mm, u2: -1 mm}}\n"
              "  - {on: [left, right], pressure: 100 kPa}\n"
              "steps: {count: 10, tolerance: 5e-3, noise: 2}\n"
              "monitors:\n"
              "  top_force: {on: top, reaction: u2}\n"
              "  top_shear: {on: top, reaction: u1}\n"
              "  top_moment: {on: top, reaction: w}\n");
  }

  struct Result {
    double force, shear, moment, dem_steps;
  };
  /// Runs the case with a model. @returns the last row
  Result result_of(const std::string& model, const std::string& name) const {
    write_case(model);
    const Outcome outcome = run_in(scratch_.path(), POLARGRAIN " run case.yaml -w 2 -o " + name);
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    const CsvTable history(scratch_.path() / name / "history.csv");
    const std::string summary = content(scratch_.path() / name / "summary.json");
    const std::string key = "\"dem_steps\": ";
    const std::size_t place = summary.find(key);
    EXPECT_NE(place, std::string::npos);
    return {history.numbers("top_force").back(), history.numbers("top_shear").back(),
            history.numbers("top_moment").back(), std::stod(summary.substr(place + key.size()))};
  }

  Scratch scratch_;
};

TEST_F(CosseratRunsTest, AdaptiveAndInformedRunsStayNearTheFullOne) {
  const Result full = result_of("cell", "full");
  const Result zero = result_of("adaptive, adaptive: {tolerance: 0}", "zero");
  // A cell a point: the same grains, but that answers are carried along the tangent while the cell stands still.
  EXPECT_NEAR(zero.force / full.force, 1.0, 1e-3);
  const auto compare = [&](const std::string& name, const Result& run) {
    std::cout << "[figure] " << name << ": force " << run.force / full.force << ", shear "
              << run.shear / full.shear << ", moment of the plate " << run.moment / full.moment
              << " of the full run's, " << full.dem_steps / run.dem_steps << " times fewer DEM steps\n";
  };
  compare("tolerance 0", zero);
  // Another way to the same balance: apart by what a tolerance of 5e-3 leaves open.
  const Result secant = result_of("cell, tangent: secant", "secant");
  compare("secant", secant);
  EXPECT_NEAR(secant.force / full.force, 1.0, 0.005);
  EXPECT_NEAR(secant.shear / full.shear, 1.0, 0.01);
  EXPECT_NEAR(secant.moment / full.moment, 1.0, 0.02);
  const Result adaptive = result_of("adaptive, adaptive: {tolerance: 2 %, audit: 0}", "adaptive");
  compare("tolerance 2 %", adaptive);
  EXPECT_NEAR(adaptive.force / full.force, 1.0, 0.02);
  EXPECT_NEAR(adaptive.shear / full.shear, 1.0, 0.03);
  EXPECT_NEAR(adaptive.moment / full.moment, 1.0, 0.05);
  EXPECT_GT(full.dem_steps / adaptive.dem_steps, 2.0);
  const Result informed = result_of("informed, informed: {update: fixed_point}", "informed");
  compare("informed", informed);
  EXPECT_NEAR(informed.force / full.force, 1.0, 0.15);
}

TEST_F(CosseratRunsTest, WorkersKillsAndResumptionsChangeNoByte) {
  for (const char* model : {"adaptive, adaptive: {tolerance: 2 %, audit: 5 %}", "informed",
                            "informed, informed: {update: fixed_point}", "cell, tangent: secant"}) {
    write_case(model);
    const std::string name = std::to_string(std::char_traits<char>::length(model));
    const std::string run = "run case.yaml --quiet --checkpoint-minutes 0";
    ASSERT_EQ(run_in(scratch_.path(), POLARGRAIN " " + run + " -w 1 -o one" + name).status, 0) << model;
    const std::string expected = results_of(scratch_.path() / ("one" + name));
    RunningProgram disturbed(scratch_.path(), run + " -w 2 -o two" + name);
    const int kills =
        kill_workers(disturbed, scratch_.path() / ("two" + name) / "history.csv", 3, 1.0, 20260103).sent;
    EXPECT_EQ(disturbed.wait(), 0) << content(scratch_.path() / "program.out");
    EXPECT_TRUE(results_of(scratch_.path() / ("two" + name)) == expected) << model;
    const auto check = [&](int status, const std::filesystem::path& result) {
      EXPECT_EQ(status, 0) << content(scratch_.path() / "program.out");
      EXPECT_TRUE(results_of(result) == expected) << model;
      std::filesystem::remove_all(result);
    };
    const Kills done = kill_again_and_again(scratch_.path(), "run case.yaml --quiet", 3, 20260104, check);
    std::cout << "[figure] " << model << ": " << kills << " workers killed, " << done.kills
              << " runs killed, " << done.resumed << " resumed\n";
  }
}

}  // namespace
}  // namespace polargrain::testing
