// SPDX-License-Identifier: GPL-2.0-or-later
// Simple shear of 10 % in large deformation, of real grains: `adaptive` against a cell at every point.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numeric>
#include <vector>

#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

class LargeShear : public ::testing::Test {
 protected:
  LargeShear() : scratch_("large_shear") {
    std::filesystem::copy_file(kSource + "/cases/footing_cells/packing100.h5", scratch_.path() / "grains.h5");
  }
  [[nodiscard]] Outcome run(const std::string& name, const std::string& model) const {
    write(scratch_.path() / (name + ".yaml"),
          "title: Simple shear\n"
          "mesh: {rectangle: {size: [0.2 m, 0.2 m], elements: [2, 2]}, element: Q8R}\n"
          "deformation: large\n"
          "materials:\n  sand: {model: " +
              model + ", script: " + kSource +
              "/liggghts_inputs/cells/hooke_radii.in, packing: grains.h5, lc: 20 mm}\n"
              "regions: {all: sand}\nboundary:\n"
              "  - {on: bottom, fix: [u1, u2]}\n"
              "  - {on: top, move: {u1: 20 mm}, pressure: 100 kPa}\n"
              "  - {on: left, tie: right}\n"
              "steps: {count: 40, cut: 6, iterations: 20, tolerance: 1e-2}\n"
              "monitors: {shear: {on: top, reaction: u1}}\n");
    return run_in(scratch_.path(),
                  POLARGRAIN " run " + name + ".yaml --trust-scripts -w 1 --quiet -o " + name);
  }
  [[nodiscard]] std::vector<double> column(const std::string& run, const std::string& name) const {
    return CsvTable(scratch_.path() / run / "history.csv").numbers(name);
  }

  const std::string kSource = POLARGRAIN_SOURCE_DIRECTORY;
  Scratch scratch_;
};

TEST_F(LargeShear, AdaptiveGoesThroughTenPercentAsCellDoes) {
  const Outcome full = run("full", "cell");
  ASSERT_EQ(full.status, 0) << full.errors;
  const Outcome adaptive = run("adaptive", "adaptive, adaptive: {tolerance: 2 %}");
  ASSERT_EQ(adaptive.status, 0) << adaptive.errors;

  // Behind 4 % the path of a box of 100 grains hangs on the last digits: cells with a tolerance of 1e-4 in place of 1e-2
  // differ by 2 % there, and by 20 % at 10 %.
  constexpr std::size_t kSteps = 16;
  const std::vector<double> shear = column("full", "shear");
  const std::vector<double> shear_adaptive = column("adaptive", "shear");
  ASSERT_EQ(shear.size(), 41U);
  ASSERT_EQ(shear_adaptive.size(), 41U);
  double error = 0.0;
  for (std::size_t step = 1; step <= kSteps; ++step)
    error = std::max(error, std::abs(shear_adaptive[step] - shear[step]) / (0.2 * 100e3));
  const auto jumps_of = [&](const std::string& name) {
    const std::vector<double> jumps = column(name, "jumps");
    return std::accumulate(jumps.begin(), jumps.end(), 0.0);
  };
  const double jumps = jumps_of("adaptive");
  std::cout << "[figure] shear stress to 4 %: within " << error
            << " of the pressure; jumps to 10 %: " << jumps << ", of cell " << jumps_of("full") << '\n';
  EXPECT_LT(error, 0.02) << "the tolerance";
  EXPECT_LT(jumps, 10) << "of 40 steps";
}

}  // namespace
}  // namespace polargrain::testing
