// SPDX-License-Identifier: GPL-2.0-or-later
// Ground of boxes of grains whose pores hold water.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::string kSource = POLARGRAIN_SOURCE_DIRECTORY;
const std::string kPacking = kSource + "/cases/footing_cells/packing100.h5";

/// A column of boxes at rest under 100 kPa, which takes 30 kPa more.
std::string column(const std::string& model, const std::string& water, const std::string& monitors = "") {
  return "title: A column of boxes\n"
         "mesh: {rectangle: {size: [0.1 m, 0.2 m], elements: [1, 2]}}\n"
         "materials:\n"
         "  sand: {model: " +
         model + ", script: cells/hooke_radii.in, packing: " + kPacking +
         ", lc: 8 mm}\n"
         "regions: {all: sand}\n" +
         water +
         "  - {on: [left, right], fix: [u1, w]}\n"
         "  - {on: bottom, fix: [u2]}\n"
         "  - {on: top, pressure: [[0, 100 kPa], [1, 130 kPa]]}\n"
         "steps: {tolerance: 2e-3, stages: [{until: 1, count: 2}, {until: 10, count: 4}]}\n"
         "monitors:\n"
         "  top: {on: top, displacement: u2}\n" +
         monitors + "output: {every: 100}\n";
}

const std::string kDry = "boundary:\n";
/// cv is some 0.02 m2/s: a second raises the pressure, ten let it go.
const std::string kWet =
    "water: {unit_weight: 10 kN/m3, permeability: 5e-6 m/s}\nboundary:\n  - {on: top, drained: true}\n";
const std::string kHeld =
    "water: {unit_weight: 10 kN/m3, permeability: 5e-6 m/s}\nboundary:\n  - {on: all, drained: true}\n";

class WaterEngine : public ::testing::TestWithParam<const char*> {};

TEST_P(WaterEngine, ConsolidatesToTheDryState) {
  const std::string model = GetParam();
  const Scratch scratch("water_engine_" + model.substr(0, model.find(',')));
  const auto run = [&](const std::string& name, const std::string& text) {
    write(scratch.path() / (name + ".yaml"), text);
    const Outcome outcome =
        run_in(scratch.path(), POLARGRAIN " run " + name + ".yaml -o " + name + " -w 2 --quiet");
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    return CsvTable(scratch.path() / name / "history.csv");
  };
  const CsvTable dry = run("dry", column(model, kDry));
  const CsvTable held = run("held", column(model, kHeld));
  const CsvTable wet = run(
      "wet", column(model, kWet, "  p: {on: bottom, water: pressure}\n  out: {on: top, water: outflow}\n"));
  const double settlement = dry.numbers("top").back();
  const auto p = wet.numbers("p");
  std::cout << "[figure] " << model << ": settlement dry " << settlement << " m, held "
            << held.numbers("top").back() << " m, consolidated " << wet.numbers("top").back() << " m; p "
            << *std::ranges::max_element(p) << " Pa at most, " << p.back() << " Pa at the end\n";
  EXPECT_LT(settlement, -1e-6);
  // Pressures of zero leave the balance of the dry column; iterations end within the tolerance.
  EXPECT_NEAR(held.numbers("top").back() / settlement, 1.0, 0.02);
  // By another way to the same stress: grains remember some of it.
  EXPECT_NEAR(wet.numbers("top").back() / settlement, 1.0, 0.05);
  EXPECT_GT(*std::ranges::max_element(p), 5e3);
  EXPECT_LT(std::abs(p.back()), 0.02 * 30e3);
  // Grains do not shrink: the water that has left made the room, but for what is stored.
  EXPECT_NEAR(wet.numbers("out").back() / (-0.1 * wet.numbers("top").back()), 1.0, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Models, WaterEngine, ::testing::Values("cell", "adaptive, tolerance: 2 %"),
                         [](const auto& info) { return std::string(info.index == 0 ? "cell" : "adaptive"); });

/// A closed element that is compressed is an undrained test.
TEST(WaterEngineUndrained, AClosedElementIsAnUndrainedTest) {
  const Scratch scratch("water_undrained");
  const Outcome point =
      run_in(scratch.path(), POLARGRAIN
                                 " element --test biaxial --pressure 100kPa --set drainage=undrained "
                                 "--set axial_strain=0.3% --set rows=6 --set tolerance=1e-4 " +
                                 kPacking + " cells/hooke_radii.in -w 1");
  ASSERT_EQ(point.status, 0) << point.errors;
  write(scratch.path() / "case.yaml",
        "title: one element\n"
        "mesh: {rectangle: {size: [10 mm, 10 mm], elements: [1, 1]}}\n"
        "materials: {sand: {model: cell, script: cells/hooke_radii.in, packing: " +
            kPacking + R"(, lc: 8 mm}}
regions: {all: sand}
water: {bulk_modulus: 9e4 GPa, undrained: true}
boundary:
  - {on: bottom, fix: [u2]}
  - {on: left, fix: [u1]}
  - {on: all, fix: [w]}
  - {on: top, move: {u2: [[0 s, 0 mm], [1 s, -0.03 mm]]}}
  - {on: right, pressure: 100 kPa}
steps: {duration: 1 s, count: 6, tolerance: 1e-4, line_search: 3, acceleration: 5}
monitors:
  force: {on: top, reaction: u2}
  p: {on: all, water: pressure}
output: {every: 100}
)");
  const Outcome mesh = run_in(scratch.path(), POLARGRAIN " run case.yaml -o out -w 1 --quiet");
  ASSERT_EQ(mesh.status, 0) << mesh.errors;
  const CsvTable of_point(scratch.path() / "element.csv");
  const CsvTable of_mesh(scratch.path() / "out/history.csv");
  double worst_pressure = 0.0;
  double worst_stress = 0.0;
  for (std::size_t step = 1; step <= 6; ++step) {
    const std::size_t row = of_point.rows() - 7 + step;
    const std::size_t of_history = of_mesh.rows() - 7 + step;
    const double p = of_mesh.numbers("p")[of_history];
    const double effective = of_mesh.numbers("force")[of_history] / 10e-3 + p;
    worst_pressure = std::max(worst_pressure, std::abs(p - of_point.numbers("pore_pressure_Pa")[row]));
    worst_stress = std::max(worst_stress, std::abs(effective - of_point.numbers("s22_Pa")[row]));
  }
  std::cout << "[figure] closed element against an undrained test: pressure " << worst_pressure
            << " Pa, axial stress " << worst_stress << " Pa\n";
  // The test is in large deformation, the mesh in small: strains of 0.3 % differ by their square.
  EXPECT_LT(worst_pressure, 3e3);
  EXPECT_LT(worst_stress, 3e3);
}

}  // namespace
}  // namespace polargrain::testing
