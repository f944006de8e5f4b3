// SPDX-License-Identifier: GPL-2.0-or-later
// A column of real grains that begins almost without stress and is loaded by its own weight: statics, and `adaptive`
// against a cell at every point.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <vector>

#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

constexpr double kWidth = 0.5;        // m
constexpr double kHeight = 10.0;      // m
constexpr double kUnitWeight = 20e3;  // N/m3
constexpr double kReference = 100e3;  // Pa
constexpr double kTolerance = 0.01;

class OwnWeight : public ::testing::Test {
 protected:
  OwnWeight() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    write(scratch_.path() / "packing.yaml",
          "title: almost without stress\ngrains: 100\nsizes: {law: uniform, radius: [3 mm, 7 mm]}\n"
          "density: 2650\nthickness: 100 mm\nscript: " +
              kSource + "/liggghts_inputs/cells/hooke_radii.in\npressure: 1 kPa\nfriction: 0.3\nseed: 1\n");
  }
  [[nodiscard]] Outcome polargrain(const std::string& arguments) const {
    return run_in(scratch_.path(), POLARGRAIN " " + arguments);
  }
  /// Runs the column with a model; its results are named by the first argument.
  [[nodiscard]] Outcome run(const std::string& name, const std::string& model) const {
    write(scratch_.path() / (name + ".yaml"),
          "title: A column under its own weight\n"
          "mesh: {rectangle: {size: [0.5 m, 10 m], elements: [1, 5]}, element: Q8R}\n"
          "materials:\n  sand: {model: " +
              model + ", script: " + kSource +
              "/liggghts_inputs/cells/hooke_radii.in, packing: packing.h5, lc: 10 mm}\n"
              "regions: {all: sand}\nboundary:\n"
              "  - {on: bottom, fix: [u1, u2]}\n  - {on: [left, right], fix: [u1]}\n"
              "  - {on: top, pressure: [[0, 1 kPa], [0.5, 0]]}\n"
              "body:\n  - {unit_weight: 20 kN/m3, factor: [[0, 0], [1, 1]]}\n"
              "steps: {count: 10, cut: 6, iterations: 30, tolerance: 2e-3, noise: 2}\n"
              "monitors:\n  settlement: {on: top, displacement: u2}\n"
              "  lateral: {on: left, reaction: u1}\n  base: {on: bottom, reaction: u2}\n");
    return polargrain("run " + name + ".yaml --trust-scripts -w 1 --quiet -o " + name);
  }
  [[nodiscard]] std::vector<double> column(const std::string& run, const std::string& name) const {
    return CsvTable(scratch_.path() / run / "history.csv").numbers(name);
  }

  const std::string kSource = POLARGRAIN_SOURCE_DIRECTORY;
  Scratch scratch_;
};

TEST_F(OwnWeight, AColumnFromAlmostZeroStressIsWithinAStatedTolerance) {
  ASSERT_EQ(polargrain("pack packing.yaml --trust-scripts --quiet -o packing.h5").status, 0);
  const Outcome full = run("full", "cell");
  ASSERT_EQ(full.status, 0) << full.errors;
  const Outcome adaptive =
      run("adaptive", "adaptive, adaptive: {tolerance: 1 %, reference_pressure: 100 kPa}");
  ASSERT_EQ(adaptive.status, 0) << adaptive.errors;

  const std::vector<double> weight = column("adaptive", "base");
  // Statics: what stands on the base is the weight; steps are balanced to 2e-3 of their loads.
  const double whole = kUnitWeight * kWidth * kHeight;
  EXPECT_NEAR(weight.back(), whole, 2e-3 * whole);

  const std::vector<double> settled = column("full", "settlement");
  const std::vector<double> lateral = column("full", "lateral");
  const std::vector<double> settled_adaptive = column("adaptive", "settlement");
  const std::vector<double> lateral_adaptive = column("adaptive", "lateral");
  ASSERT_EQ(settled.size(), settled_adaptive.size());
  double error = 0.0;
  for (std::size_t k = 0; k < settled.size(); ++k)
    error = std::max(error, std::abs(lateral[k] - lateral_adaptive[k]) / kHeight);
  const double error_settled = std::abs(settled.back() - settled_adaptive.back());
  std::cout << "[figure] lateral stress, mean over the height: within " << error << " Pa of a mean of "
            << std::abs(lateral.back()) / kHeight << " Pa; settlement within " << error_settled << " of "
            << -settled.back() << " m\n";
  // Nothing but the cells says what the lateral stress is. 1 % of 100 kPa, as the run was asked for; the packing's own
  // pressure is 1 kPa, of which 1 % would be 10 Pa.
  EXPECT_LT(error, kTolerance * kReference);
  EXPECT_GT(std::abs(lateral.back()) / kHeight, 20.0 * kTolerance * kReference);
  EXPECT_LT(error_settled, 0.02 * -settled.back());
  EXPECT_LT(settled.back(), -0.01);
}

}  // namespace
}  // namespace polargrain::testing
