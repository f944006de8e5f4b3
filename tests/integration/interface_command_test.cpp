// SPDX-License-Identifier: GPL-2.0-or-later
// polargrain interface with the engine, in a size that says nothing of sand, and what a case makes of its result.
#include <gtest/gtest.h>

#include <iostream>

#include "common/csv_table.hpp"
#include "coupler/case/measured_interface.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::string kProgram = POLARGRAIN;

constexpr const char* kGrains =
    "grains: 100\nsizes: {law: uniform, radius: [3 mm, 7 mm]}\ndensity: 2650\nthickness: 100 mm\n"
    "script: cells/hooke_li_chu.in\npressure: 100 kPa\nfriction: 0\nseed: 1\n";
const std::string kSmall =
    " interface grains.yaml -o out --grains 100 --height 8 --seeds 1,2 --roughness 0.1,1 --way 2 --inertial-number 4e-3";

/// A block of elements on a wall of those grains.
constexpr const char* kCase =
    "title: a block on a wall\nmesh: {rectangle: {size: [0.4 m, 0.05 m], elements: [2, 1]}}\n"
    "materials: {ground: {model: elastic, E: 20 MPa, nu: 0.2, Gc: 4 MPa, lc: 10 mm}}\nregions: {all: ground}\n"
    "interfaces:\n  wall: {on: bottom, friction: measured, packing: out/grains100-seed1.h5, roughness: 1}\n"
    "boundary:\n  - {on: wall, fix: [u1, u2]}\n  - {on: top, move: {u1: 25 mm}, pressure: 100 kPa}\n"
    "steps: {count: 10}\nmonitors:\n  shear: {interface: wall, value: shear}\n"
    "output: {every: 10, points: no, table: [shear]}\n";

TEST(InterfaceCommand, MeasuresFrictionThatACaseReadsAndGoesOnWhereItWas) {
  const Scratch scratch("interface");
  write(scratch.path() / "grains.yaml", kGrains);
  const Outcome made = run_in(scratch.path(), kProgram + kSmall);
  ASSERT_EQ(made.status, 0) << made.errors;
  EXPECT_EQ(made.errors.find("unbalanced"), std::string::npos) << made.errors;
  const CsvTable walls(scratch.path() / "out/walls.csv");
  ASSERT_EQ(walls.rows(), 4u);
  for (std::size_t row = 0; row < walls.rows(); ++row) {
    // Friction of half a radian with rolling resistance: tan of it is 0.55; few grains interlock by up to as much again.
    EXPECT_GT(walls.number(row, walls.column("peak")), 0.1);
    EXPECT_LT(walls.number(row, walls.column("peak")), 1.2);
  }
  const auto measured =
      coupler::read_measured_interface(scratch.path() / "out/grains100-seed1.interface.yaml");
  ASSERT_EQ(measured.walls.size(), 2u);
  // Two diameters of each box; the grains of two boxes differ in the mean by less than a thousandth.
  EXPECT_NEAR(measured.walls[1].curve.back().slip / measured.mean_diameter, 2.0, 2e-3);
  std::cout << "[figure] friction at the end: " << measured.walls[0].curve.back().friction
            << " on grains of 0.1 d, " << measured.walls[1].curve.back().friction << " of 1 d\n";

  // All is there: nothing is made again.
  const std::string table = content(scratch.path() / "out/walls.csv");
  const auto history = scratch.path() / "out/grains100-seed1-wall1/history.csv";
  const auto written = std::filesystem::last_write_time(history);
  const Outcome again = run_in(scratch.path(), kProgram + kSmall);
  ASSERT_EQ(again.status, 0) << again.errors;
  EXPECT_EQ(content(scratch.path() / "out/walls.csv"), table);
  EXPECT_EQ(std::filesystem::last_write_time(history), written);

  // The block slides by twice the slip that was measured: the friction of the end carries it.
  write(scratch.path() / "case.yaml", kCase);
  const Outcome run = run_in(scratch.path(), kProgram + " run case.yaml -o block --quiet");
  ASSERT_EQ(run.status, 0) << run.errors;
  const CsvTable block(scratch.path() / "block/history.csv");
  const double shear = std::abs(block.number(block.rows() - 1, block.column("shear")));
  // Everywhere it slides and presses with 100 kPa on 0.4 m; friction does not depend on where.
  EXPECT_NEAR(shear / 40e3, measured.walls[1].curve.back().friction, 1e-3);

  write(scratch.path() / "grains.yaml", std::string(kGrains) + "# 2\n");
  const Outcome changed = run_in(scratch.path(), kProgram + kSmall);
  EXPECT_EQ(changed.status, 2);
  EXPECT_NE(changed.errors.find("holds boxes of another specification"), std::string::npos) << changed.errors;
}

// Without rest the law begins above its own peak.
TEST(InterfaceCommand, HurriedGrainsAreTold) {
  const Scratch scratch("interface_hurried");
  write(scratch.path() / "grains.yaml", kGrains);
  const Outcome made = run_in(
      scratch.path(),
      kProgram +
          " interface grains.yaml -o out --grains 100 --height 6 --seeds 1,2 --roughness 1 --way 2 --inertial-number 0.05");
  ASSERT_EQ(made.status, 0) << made.errors;
  EXPECT_NE(made.errors.find("warning: out: the mean unbalanced ratio of the grains is 0."),
            std::string::npos)
      << made.errors;
  EXPECT_NE(made.errors.find("give a smaller --inertial-number than 0.05"), std::string::npos) << made.errors;
}

TEST(InterfaceCommand, MistakesAreFoundBeforeAnythingIsMade) {
  const Scratch scratch("interface_mistakes");
  write(scratch.path() / "grains.yaml", kGrains);
  const auto errors_of = [&](const std::string& options) {
    const Outcome outcome = run_in(scratch.path(), kProgram + " interface grains.yaml " + options);
    EXPECT_EQ(outcome.status, 2) << options;
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "interface-results")) << options;
    return outcome.errors;
  };
  EXPECT_NE(errors_of("--seeds 1").find("one box does not show the scatter"), std::string::npos);
  EXPECT_NE(errors_of("--seeds 1,1").find("no independent samples"), std::string::npos);
  EXPECT_NE(errors_of("--roughness 0").find("--roughness"), std::string::npos);
  EXPECT_NE(errors_of("--set script=cells/none.in").find("none.in"), std::string::npos);
  write(scratch.path() / "grains.yaml",
        "grains: 100\nsizes: {law: uniform, radius: [3 mm, 7 mm]}\ndensity: 2650\ndimension: 3\n"
        "script: cells/spheres_hooke_radii.in\npressure: 100 kPa\nfriction: 0\n");
  EXPECT_NE(errors_of("").find("is of spheres in space; boxes on walls are made of discs"),
            std::string::npos);
}

}  // namespace
}  // namespace polargrain::testing
