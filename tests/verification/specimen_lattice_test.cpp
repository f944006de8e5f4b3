// SPDX-License-Identifier: GPL-2.0-or-later
// The biaxial apparatus (platens, membranes) around a lattice of equal discs, whose strength is known: Rowe
// 1962, docs/theory.md E.7(c).
#include "tests/support/specimen_lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <sstream>
#include <vector>

#include "tests/integration/command.hpp"

namespace {

using namespace polargrain::testing;

/// Runs a script of the specimens.
void run_script(const std::string& script, const std::string& variables) {
  const ScriptRun run = run_liggghts_script(SPECIMEN_INPUTS, script, variables);
  EXPECT_EQ(run.status, 0) << run.text;
}

struct Row {
  double step = 0.0, strain = 0.0, ratio = 0.0, volume = 0.0, width = 0.0, height = 0.0, top = 0.0,
         bottom = 0.0, unbalanced = 0.0, grains = 0.0;
};

std::vector<Row> read_history(const std::filesystem::path& file) {
  std::vector<Row> rows;
  std::istringstream text(content(file));
  for (std::string line; std::getline(text, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    Row row;
    if (words >> row.step >> row.strain >> row.ratio >> row.volume >> row.width >> row.height >> row.top >>
        row.bottom >> row.unbalanced >> row.grains)
      rows.push_back(row);
  }
  return rows;
}

/// Seats the lattice and compresses it to 0.25 %; the rows of the compression.
std::vector<Row> compress(const Scratch& scratch, double friction) {
  for (const char* folder : {"restart", "grains"}) std::filesystem::create_directory(scratch.path() / folder);
  write_lattice(scratch.path() / "lattice.data");
  const std::string common = "-var folder " + scratch.path().string() +
                             " -var rolling_model off -var rolling_force off -var pressure " +
                             std::to_string(kPressure);
  const std::string mu = std::to_string(friction);
  run_script("seating.in", common + " -var data " + (scratch.path() / "lattice.data").string() +
                               " -var final_friction " + mu + " -var final_rolling 0 -var steps 400");
  run_script("compression.in",
             common + " -var start " + (scratch.path() / "restart/step-0.restart").string() +
                 " -var friction " + mu +
                 " -var rolling 0 -var rate 0.024 -var steps 6800 -var frames 2 -var row_steps 40");
  return read_history(scratch.path() / "history.csv");
}

TEST(SpecimenLattice, FailsAtRowesStressRatio) {
  for (const double friction : {0.1, 0.2}) {
    const Scratch scratch("specimen_lattice");
    const std::vector<Row> rows = compress(scratch, friction);
    ASSERT_EQ(rows.size(), 340U);
    double peak = 0.0;
    for (const Row& row : rows) peak = std::max(peak, row.ratio);
    const double beta = std::numbers::pi / 3.0;
    const double exact = std::tan(beta) * std::tan(beta + std::atan(friction));
    std::cout << "[figure] lattice with friction " << friction << ": peak stress ratio " << peak << ", Rowe "
              << exact << "\n";
    // 15 rows are no infinite lattice: the outer two are held by platens, and count 1 r instead of sqrt(3) /
    // 2 r to the height that the pressure acts on.
    EXPECT_NEAR(peak / exact, 1.0, 0.04);
    // It softens as the discs climb: the ratio falls from the peak on.
    EXPECT_LT(rows.back().ratio, 0.98 * peak);
  }
}

TEST(SpecimenLattice, IsAtRestUnderThePressureWhenSeated) {
  const Scratch scratch("specimen_seated");
  const std::vector<Row> rows = compress(scratch, 0.2);
  ASSERT_FALSE(rows.empty());
  // After forty steps of the compression the strain is 1e-7: of the elastic stress ratio 1e4 strain.
  EXPECT_NEAR(rows.front().ratio, 1.0, 0.01);
  EXPECT_EQ(rows.front().grains, 16.0);  // the default probe, of two radii, rests on every second row
  // Width between the centre lines of the outer discs, seven diameters, less 1 / 3000 of elastic strain.
  EXPECT_NEAR(rows.front().width, 14.0 * kRadius, 14.0 * kRadius * 1e-3);
  EXPECT_NEAR(rows.front().height, kRadius * (2.0 + std::sqrt(3.0) * (kRows - 1)), 1e-3 * 0.13);
}

}  // namespace
