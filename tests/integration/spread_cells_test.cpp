// SPDX-License-Identifier: GPL-2.0-or-later
// Slips of cells that are spread, by the whole program: uniform states, workers, a run that is killed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/csv_table.hpp"
#include "tests/faults/checkpoint_runs.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::filesystem::path kSource = POLARGRAIN_SOURCE_DIRECTORY;

/// Three elements of one cell each between smooth plates: all alike, so that nothing is there to be spread.
class SpreadCells : public ::testing::Test {
 protected:
  SpreadCells() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::copy(kSource / "cases/footing_cells/packing100.h5", scratch_.path());
  }

  void write_case(const std::string& continuum, const std::string& model) const {
    write(scratch_.path() / "case.yaml",
          "title: Cells that slip together\ncontinuum: " + continuum +
              "\nmesh: {rectangle: {size: [0.1 m, 0.3 m], elements: [1, 3]}, element: Q4R}\n"
              "materials:\n  sand: {model: " +
              model +
              ", script: cells/hooke_li_chu.in, packing: packing100.h5}\n"
              "regions: {all: sand}\n"
              "boundary:\n"
              "  - {on: bottom, fix: [u2]}\n"
              "  - {on: bottom_left, fix: [u1]}\n"
              "  - {on: top, move: {u2: -6 mm}}\n"
              "  - {on: [left, right], pressure: 100 kPa}\n"
              "steps: " +
              steps_ +
              "\n"
              "monitors: {top_force: {on: top, reaction: u2}}\n");
  }
  void write_case_in_space(const std::string& continuum, const std::string& model) const {
    write(scratch_.path() / "case.yaml",
          "title: Cells of spheres that slip together\ncontinuum: " + continuum +
              "\nmesh: {box: {size: [0.1 m, 0.1 m, 0.3 m], elements: [1, 1, 3]}, element: H8R}\n"
              "materials:\n  sand: {model: " +
              model + ", script: cells/spheres_hooke_radii.in, packing: " +
              (kSource / "cases/spheres/packing1000.csv").string() +
              "}\n"
              "regions: {all: sand}\n"
              "boundary:\n"
              "  - {on: bottom, fix: [u3]}\n"
              "  - {on: left, fix: [u1]}\n"
              "  - {on: front, fix: [u2]}\n"
              "  - {on: top, move: {u3: -1.5 mm}}\n"
              "  - {on: [right, back], pressure: 100 kPa}\n"
              "steps: " +
              (steps_ == kExplicit ? kExplicit : "{count: 10, tolerance: 2e-3, noise: 2}") +
              "\n"
              "monitors: {top_force: {on: top, reaction: u3}}\n");
  }
  std::vector<double> forces(const std::string& name) const {
    const Outcome run = run_in(scratch_.path(), POLARGRAIN " run case.yaml -w 2 --quiet -o " + name);
    EXPECT_EQ(run.status, 0) << run.errors;
    return CsvTable(scratch_.path() / name / "history.csv").numbers("top_force");
  }

  /// The largest difference of the forces with a spread from those without one, over the latter; along all rows.
  double farthest(const char* model, bool in_space) const {
    const auto made = [&](const char* continuum) {
      in_space ? write_case_in_space(continuum, model) : write_case(continuum, model);
      return forces(fmt::format("{}_{}_{}", model, in_space, continuum == kSpread));
    };
    const std::vector<double> local = made("cauchy"), spread = made(kSpread);
    EXPECT_EQ(spread.size(), local.size());
    EXPECT_GT(local.back() / local.front(), 2.0) << model << " " << in_space;
    double most = 0.0;
    for (std::size_t k = 0; k < std::min(local.size(), spread.size()); ++k)
      most = std::max(most, std::abs(spread[k] / local[k] - 1.0));
    return most;
  }
  void expect_the_same_bytes_of_workers_and_resumptions() const {
    const std::string run = "run case.yaml --quiet --checkpoint-minutes 0";
    ASSERT_EQ(run_in(scratch_.path(), POLARGRAIN " " + run + " -w 1 -o one").status, 0);
    const std::string expected = results_of(scratch_.path() / "one");
    const auto check = [&](int status, const std::filesystem::path& result) {
      EXPECT_EQ(status, 0) << content(scratch_.path() / "program.out");
      EXPECT_TRUE(results_of(result) == expected);
      std::filesystem::remove_all(result);
    };
    const Kills done = kill_again_and_again(scratch_.path(), "run case.yaml --quiet", 2, 20260104, check);
    EXPECT_EQ(done.kills, 2);
  }

  static constexpr const char* kSpread = "{kind: cauchy, spread: 0.2 m}";
  static constexpr const char* kExplicit = "{count: 8, method: explicit}";
  std::string steps_ = "{count: 8, tolerance: 5e-3, noise: 2}";
  Scratch scratch_;
};

TEST_F(SpreadCells, AUniformSpecimenBearsWhatItsCellsBear) {
  // Both are balanced to 0.5 % of the forces of all supports, stiff spheres to 0.2 %.
  for (const char* model : {"cell", "informed"})
    for (const bool in_space : {false, true}) EXPECT_LE(farthest(model, in_space), 0.01) << model << in_space;
}

// The damping bears half of the growth over one explicit step: in the first of 8 rows, where spheres are told to be 7 % off, 1.3 %.
TEST_F(SpreadCells, AUniformSpecimenInExplicitStepsBearsWhatItsCellsBear) {
  steps_ = kExplicit;
  EXPECT_LE(farthest("cell", false), 0.005);
  EXPECT_LE(farthest("informed", false), 0.01);
  EXPECT_LE(farthest("cell", true), 0.02);
}

// Ten boxes above each other, sheared to their peak. Without the damping of n:T waves grow until nodes_unbalanced is 0.8.
TEST_F(SpreadCells, AColumnInExplicitStepsStaysCalm) {
  write(
      scratch_.path() / "case.yaml",
      "title: A column of cells that slip together\n"
      "continuum: {kind: cauchy, spread: 54 mm, hold: [bottom, top]}\n"
      "mesh: {rectangle: {size: [0.02 m, 0.2 m], elements: [1, 10], patch: [0.02 m, 0.1 m]}, element: Q4R}\n"
      "materials:\n"
      "  sand: {model: cell, script: cells/hooke_li_chu.in, packing: packing100.h5}\n"
      "  other: {model: cell, script: cells/hooke_li_chu.in, packing: " +
          (kSource / "cases/studies/dense100_seed2.h5").string() +
          "}\n"
          "regions: {patch: sand, rest: other}\n"
          "boundary:\n"
          "  - {on: left, tie: right}\n"
          "  - {on: bottom, fix: [u1, u2]}\n"
          "  - {on: top, move: {u1: 8 mm}, pressure: 100 kPa}\n"
          "steps: {count: 20, method: explicit}\n"
          "monitors: {top_force: {on: top, reaction: u1}}\n");
  ASSERT_EQ(forces("column").size(), 21U);
  const std::vector<double> unbalanced =
      CsvTable(scratch_.path() / "column/history.csv").numbers("nodes_unbalanced");
  EXPECT_LE(*std::ranges::max_element(unbalanced), 0.05);
}

TEST_F(SpreadCells, WorkersAndResumptionsChangeNoByte) {
  write_case(kSpread, "cell");
  expect_the_same_bytes_of_workers_and_resumptions();
}

TEST_F(SpreadCells, WorkersAndResumptionsChangeNoByteOfExplicitSteps) {
  steps_ = kExplicit;
  write_case(kSpread, "cell");
  expect_the_same_bytes_of_workers_and_resumptions();
}

TEST_F(SpreadCells, RefusesWhatHasNoSlipsToSpread) {
  write_case(kSpread, "adaptive");
  const Outcome run = run_in(scratch_.path(), POLARGRAIN " check case.yaml");
  EXPECT_NE(run.status, 0);
  EXPECT_NE(run.errors.find(
                "case.yaml:2: continuum: spread: the model of material 'sand' cannot spread its slips yet; "
                "elastic, elastoplastic, cell and informed ones can"),
            std::string::npos)
      << run.errors;
}

}  // namespace
}  // namespace polargrain::testing
