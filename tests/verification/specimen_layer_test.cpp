// SPDX-License-Identifier: GPL-2.0-or-later
// Rows of equal discs sheared over each other by fix layer: a row that climbs out of the gaps of the one below has a
// strength and a rise in closed form.
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

constexpr double kShearRate = 0.5;  // 1/s, of the height at the start

/// Of a layer of spheres: two planes of them, which do not touch.
constexpr int kPlanes = 2;
constexpr double kDepth = 2.1 * kRadius * kPlanes;

/// Two or more rows of touching discs, or spheres, over a periodic width; the lowest and the highest are the plates.
void write_rows(const std::filesystem::path& file, int rows, bool spheres = false) {
  std::ofstream out(file);
  out.precision(17);
  const double density = spheres ? 2650.0 : 2650.0 * 0.1;  // as in write_lattice
  const double depth = spheres ? kDepth : 0.1;
  const int planes = spheres ? kPlanes : 1;
  out << "rows\n\n"
      << planes * rows * kColumns << " atoms\n1 atom types\n\n0 " << 2.0 * kRadius * kColumns
      << " xlo xhi\n-0.05 0.1 ylo yhi\n"
      << -0.5 * depth << " " << 0.5 * depth << " zlo zhi\n\nAtoms\n\n";
  int id = 0;
  for (int plane = 0; plane < planes; ++plane)
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < kColumns; ++column)
        out << ++id << " 1 " << 2.0 * kRadius << " " << density << " " << kRadius * (2 * column + 1 + row % 2)
            << " " << kRadius * std::sqrt(3.0) * (1.0 - 1e-5) * row << " "
            << depth * ((plane + 0.5) / planes - 0.5) << "\n";
}

/// The script of a layer, of spheres where asked.
std::string layer_in(const Scratch& scratch, bool spheres) {
  const std::string inputs = SPECIMEN_INPUTS;
  if (!spheres) return inputs + "/layer.in";
  std::string text = content(inputs + "/layer.in");
  for (const auto& [before, after] :
       {std::pair<std::string, std::string>{"dimension       2", "dimension       3"},
        {"fix             plane all enforce2d", ""},
        {"include         layer_shear.in", "include         " + inputs + "/layer_shear.in"}}) {
    const auto place = text.find(before);
    EXPECT_NE(place, std::string::npos) << before;
    text.replace(place, before.size(), after);
  }
  write(scratch.path() / "spheres.in", text);
  return (scratch.path() / "spheres.in").string();
}

struct Row {
  double step = 0.0, shear = 0.0, displacement = 0.0, stress = 0.0, normal_ratio = 0.0, rise = 0.0,
         height = 0.0, unbalanced = 0.0;
};

std::vector<Row> shear(const Scratch& scratch, int rows, double friction, double way, bool spheres = false) {
  std::filesystem::create_directory(scratch.path() / "grains");
  write_rows(scratch.path() / "rows.data", rows, spheres);
  // Spheres bear less than discs under one pressure: what brakes the plate weighs more.
  const double rate = spheres ? 0.5 * kShearRate : kShearRate;
  const double height = kRadius * std::sqrt(3.0) * (rows - 1);
  std::ostringstream variables;
  variables << "-var folder " << scratch.path().string() << " -var data "
            << (scratch.path() / "rows.data").string() << " -var low " << 0.1 * height << " -var high "
            << 0.9 * height << " -var pressure " << kPressure << " -var friction " << friction
            << " -var rolling_model off -var rest 2000 -var rate " << rate
            << " -var frames 10 -var row_steps 500 -var steps "
            << static_cast<int>(way / (rate * height) / 1e-5 / 10);
  if (spheres) variables << " -var thickness " << kDepth;
  const ScriptRun run = run_liggghts_script(SPECIMEN_INPUTS, layer_in(scratch, spheres), variables.str());
  EXPECT_EQ(run.status, 0) << run.text;
  std::vector<Row> history;
  std::istringstream text(content(scratch.path() / "history.csv"));
  for (std::string line; std::getline(text, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    Row row;
    if (words >> row.step >> row.shear >> row.displacement >> row.stress >> row.normal_ratio >> row.rise >>
        row.height >> row.unbalanced)
      history.push_back(row);
  }
  return history;
}

class SpecimenLayerOf : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Kinds, SpecimenLayerOf, ::testing::Values(false, true),
                         [](const auto& tested) { return tested.param ? "spheres" : "discs"; });

TEST_P(SpecimenLayerOf, ARowThatClimbsHasTheStrengthAndTheRiseOfItsGeometry) {
  for (const double friction : {0.0, 0.2, 0.5}) {
    const Scratch scratch("specimen_layer");
    const std::vector<Row> history = shear(scratch, 2, friction, 0.8 * kRadius, GetParam());
    ASSERT_GT(history.size(), 50U);
    int compared = 0;
    double largest = 0.0;
    for (const Row& row : history) {
      if (row.displacement < 0.05 * kRadius || row.displacement > 0.8 * kRadius) continue;
      // The discs of the upper plate rest on one neighbour each, at an angle that falls with the displacement.
      const double angle = std::asin(0.5 * (1.0 - row.displacement / kRadius));
      const double strength = std::tan(angle + std::atan(friction));
      const double rise = 2.0 * kRadius * (std::cos(angle) - std::cos(std::numbers::pi / 6.0));
      largest = std::max(largest, std::abs(row.stress / kPressure / strength - 1.0));
      // Overlaps are 1 / 3000 of a radius; the plate's own inertia, 2e-3 of the pressure, is in the normal stress too.
      EXPECT_NEAR(row.stress / kPressure, strength, 0.01 * strength) << row.displacement / kRadius;
      EXPECT_NEAR(row.rise, rise, 2e-3 * kRadius) << row.displacement / kRadius;
      EXPECT_NEAR(row.normal_ratio, 1.0, 0.01);
      ++compared;
    }
    std::cout << "[figure] two rows, friction " << friction << ": largest error of the strength " << largest
              << " of " << compared << " rows\n";
    EXPECT_GT(compared, 20);
  }
}

TEST(SpecimenLayer, AFreeRowCarriesWhatThePlatesDo) {
  // Without friction the rows above and below the free one climb at the same stress, one after the other or together.
  const Scratch scratch("specimen_free_row");
  const std::vector<Row> history = shear(scratch, 3, 0.0, 0.5 * kRadius);
  ASSERT_GT(history.size(), 50U);
  double peak = 0.0;
  for (const Row& row : history) peak = std::max(peak, row.stress / kPressure);
  EXPECT_NEAR(peak, std::tan(std::numbers::pi / 6.0), 0.01 * peak);
}

TEST(SpecimenLayer, SaysWhatItCannotDo) {
  const Scratch scratch("specimen_no_plate");
  std::filesystem::create_directory(scratch.path() / "grains");
  write_rows(scratch.path() / "rows.data", 2);
  const std::string common = "-var folder " + scratch.path().string() + " -var data " +
                             (scratch.path() / "rows.data").string() +
                             " -var high 0.005 -var rolling_model off";
  const ScriptRun none = run_liggghts_script(SPECIMEN_INPUTS, "layer.in", common + " -var low -0.01");
  EXPECT_NE(none.status, 0);
  EXPECT_NE(none.text.find("Fix layer: a plate has no grains"), std::string::npos) << none.text;
  const ScriptRun both = run_liggghts_script(SPECIMEN_INPUTS, "layer.in", common + " -var low 0.02");
  EXPECT_NE(both.status, 0);
  EXPECT_NE(both.text.find("Fix layer: a grain belongs to both plates"), std::string::npos) << both.text;
}

}  // namespace
