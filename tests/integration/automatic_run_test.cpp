// SPDX-License-Identifier: GPL-2.0-or-later
// `method: automatic` by the whole program: Newton's bytes where it balances, no stop where it does not, and the same bytes
// whoever has the boxes and wherever the run is broken off.
#include "tests/integration/column_run.hpp"

namespace polargrain::testing {
namespace {

class AutomaticRun : public ColumnRun {
 protected:
  void write_small(const std::string& steps, const std::string& model = "cell") const {
    write_column({.steps = steps, .model = model, .deformation = "small"});
  }
  /// One element, its grains shown no mercy: docs/hard_cells.md.
  void write_hard(const std::string& grains, const std::string& steps, const std::string& boundary) const {
    write(
        scratch_.path() / "case.yaml",
        "title: A hard case\n"
        "mesh: {rectangle: {size: [0.1 m, 0.1 m], elements: [1, 1]}}\n"
        "materials:\n  sand: {model: cell, script: cells/hooke_radii.in, packing: packing100.h5, G: 16 MPa, "
        "Gc: 14 MPa, lc: 20 mm" +
            grains + "}\nregions: {all: sand}\nboundary:\n" + boundary + "steps: {" + steps +
            "}\nmonitors:\n  top_force: {on: top, reaction: u2}\n  pressure: -top_force / 0.1 m\n");
  }
};

// Without a step that fails it is Newton's method, to the last digit.
TEST_F(AutomaticRun, IsNewtonsMethodWhereThatBalances) {
  for (const char* const model : {"cell", "informed", "adaptive"}) {
    write_small("tolerance: 1e-2, method: newton", model);
    ASSERT_EQ(run("newton").status, 0) << model;
    write_small("tolerance: 1e-2, method: automatic, effort: 400", model);
    const Outcome outcome = run("automatic");
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_EQ(column("automatic", "top_force"), column("newton", "top_force")) << model;
    EXPECT_EQ(column("automatic", "iterations"), column("newton", "iterations")) << model;
    EXPECT_EQ(summary("automatic")["automatic"]["steps_explicit"], 0) << model;
    for (const char* const result : {"newton", "automatic"})
      std::filesystem::remove_all(scratch_.path() / result);
  }
}

// An effort that is too small for most steps: explicit steps take their place, and the force stays near that of Newton's method.
TEST_F(AutomaticRun, GoesThroughStepsThatAreGivenUp) {
  write_small("tolerance: 1e-2, method: newton");
  ASSERT_EQ(run("newton").status, 0);
  for (const char* const model : {"cell", "adaptive"}) {
    write_small("tolerance: 1e-4, method: automatic, effort: 2", model);
    const Outcome outcome = run("automatic");
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
    const nlohmann::json told = summary("automatic")["automatic"];
    std::cout << "[figure] " << model << ": " << told << '\n';
    EXPECT_GT(told["steps_explicit"], 0);
    EXPECT_GT(told["iterations_given_up"], 0);
    for (const double iterations : column("automatic", "given_up")) EXPECT_LE(iterations, 2.0) << model;
    EXPECT_NE(content(scratch_.path() / "automatic/run.log").find("explicit steps go on from here"),
              std::string::npos);
    const double expected = column("newton", "top_force").back();
    EXPECT_NEAR(column("automatic", "top_force").back() / expected, 1.0, 0.03) << model;
    std::filesystem::remove_all(scratch_.path() / "automatic");
  }
}

TEST_F(AutomaticRun, WorkersKillsAndResumptionsChangeNoByte) {
  write_small("tolerance: 1e-4, method: automatic, effort: 2, pace: 4e-4");
  const std::string options = "--quiet --checkpoint-minutes 0";
  ASSERT_EQ(run("one", options + " -w 1").status, 0);
  const std::string expected = results_of(scratch_.path() / "one");
  const nlohmann::json told = summary("one")["automatic"];
  EXPECT_GT(told["steps_explicit"], 0) << told;
  ASSERT_EQ(run("three", options + " -w 3").status, 0);
  EXPECT_TRUE(results_of(scratch_.path() / "three") == expected);
  expect_the_same_behind_kills(expected, 3, 20261201, told.dump());
}

// Two hard cases that end by Newton's method, of docs/hard_cells.md: none stops, and the pressures are those that are given.
TEST_F(AutomaticRun, HardCasesDoNotStop) {
  const std::string smooth = "  - {on: bottom, fix: [u2]}\n  - {on: bottom_left, fix: [u1]}\n";
  const std::string unloading =
      smooth +
      "  - {on: [left, right, top], pressure: [[0, 100 kPa], [0.4, 25 kPa], [0.7, 5 kPa], "
      "[1, 1 kPa]]}\n";
  const std::string steps = "count: 20, tolerance: 3e-4, largest_strain: 1e-3, jumps: 0, iterations: 20";
  write_hard("", steps, unloading);
  ASSERT_EQ(run("newton").status, 1);
  write_hard("", steps + ", method: automatic, explicit_steps: 4000", unloading);
  const Outcome outcome = run("automatic");
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  std::cout << "[figure] unloading: " << summary("automatic")["automatic"] << '\n';

  const std::string extension =
      smooth + "  - {on: top, move: {u2: 2 mm}}\n  - {on: [left, right], fix: [u1]}\n";
  const std::string stretched = "count: 20, tolerance: 1e-3, jumps: 0, iterations: 20";
  write_hard("", stretched, extension);
  EXPECT_EQ(run("stretched").status, 1);
  write_hard("", stretched + ", method: automatic", extension);
  const Outcome apart = run("apart");
  EXPECT_EQ(apart.status, 0) << apart.errors;
  std::cout << "[figure] extension: " << summary("apart")["automatic"] << '\n';
  EXPECT_NEAR(column("apart", "pressure").back(), 0.0, 1e3);  // of 100 kPa
}

}  // namespace
}  // namespace polargrain::testing
