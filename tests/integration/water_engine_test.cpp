// SPDX-License-Identifier: GPL-2.0-or-later
// Ground of boxes of grains whose pores hold water.
#include <fmt/format.h>
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

INSTANTIATE_TEST_SUITE_P(Models, WaterEngine,
                         ::testing::Values("cell", "adaptive, adaptive: {tolerance: 2 %}"),
                         [](const auto& info) { return std::string(info.index == 0 ? "cell" : "adaptive"); });

/// A closed element that is compressed is an undrained test. Both see the same only where all their definitions are the same: the
/// sides are free of shear, the strains are large, water does not yield, grains rest and forces balance to rounding, and both
/// begin at the stress of the packing. (Straight sides under the shear stress that a box has differ by some 0.4 kPa, small
/// strains and the compressible water by 0.02 and 0.07 kPa.)
TEST(WaterEngineUndrained, AClosedElementIsAnUndrainedTest) {
  const Scratch scratch("water_undrained");
  const std::string rest =
      "unbalanced_force_ratio: 1e-10, unbalanced_moment_ratio: 1e-10, most_relaxation_steps: 2000000";
  const Outcome settled = run_in(
      scratch.path(), POLARGRAIN " pack --settle " + kPacking +
                          " cells/hooke_radii.in -o isotropic.h5 --quiet --set pressure_tolerance=1e-9 "
                          "--set unbalanced_force_ratio=1e-10");
  ASSERT_EQ(settled.status, 0) << settled.errors;
  const auto test_under = [&](const std::string& pressure) {
    write(scratch.path() / "point.yaml",
          "{packing: isotropic.h5, script: cells/hooke_radii.in, " + rest + ", pressure: " + pressure +
              " Pa, tolerance: 1e-9, iterations: 40,\n"
              " stages: [{e22: -0.3 %, volume: hold, s12: 0 kPa, rows: 6}]}\n");
    const Outcome outcome = run_in(scratch.path(), POLARGRAIN " element point.yaml -w 1 --quiet");
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    return CsvTable(scratch.path() / "element.csv");
  };
  // The packing is at rest to some Pa of its pressure. Both begin there.
  const std::string pressure = fmt::format("{:.9f}", -test_under("100e3").numbers("s11_Pa").front());
  const CsvTable of_point = test_under(pressure);
  write(scratch.path() / "case.yaml",
        "title: one element\n"
        "mesh: {rectangle: {size: [10 mm, 10 mm], elements: [1, 1]}}\n"
        "continuum: cauchy\n"
        "deformation: large\n"
        "materials: {sand: {model: cell, script: cells/hooke_radii.in, packing: isotropic.h5, " +
            rest + R"(}}
regions: {all: sand}
water: {bulk_modulus: 9e4 GPa, undrained: true}
boundary:
  - {on: bottom, fix: [u2]}
  - {on: bottom_left, fix: [u1]}
  - {on: top, move: {u2: [[0 s, 0 mm], [1 s, -0.03 mm]]}}
  - {on: [left, right], pressure: )" +
            pressure + R"( Pa}
steps: {duration: 1 s, count: 6, tolerance: 1e-11, line_search: 3, acceleration: 5, iterations: 60}
monitors:
  force: {on: top, reaction: u2}
  p: {on: all, water: pressure}
output: {every: 100}
)");
  const Outcome mesh = run_in(scratch.path(), POLARGRAIN " run case.yaml -o out -w 1 --quiet");
  ASSERT_EQ(mesh.status, 0) << mesh.errors;
  const CsvTable of_mesh(scratch.path() / "out/history.csv");
  double before = 0.0;  // until contacts slide
  double behind = 0.0;
  for (std::size_t step = 1; step <= 6; ++step) {
    const std::size_t row = of_point.rows() - 7 + step;
    const std::size_t of_history = of_mesh.rows() - 7 + step;
    const double p = of_mesh.numbers("p")[of_history];
    const double width = 10e-3 / (1.0 - 0.003 * static_cast<double>(step) / 6.0);
    const double effective = of_mesh.numbers("force")[of_history] / width + p;
    const double off = std::max(std::abs(p - of_point.numbers("pore_pressure_Pa")[row]),
                                std::abs(effective - of_point.numbers("s22_Pa")[row]));
    (step <= 2 ? before : behind) = std::max(step <= 2 ? before : behind, off);
  }
  std::cout << "[figure] closed element against an undrained test: " << before << " Pa to 0.1 %, " << behind
            << " Pa to 0.3 % of strain\n";
  EXPECT_LT(before, 1e-6 * 100e3);
  // Where contacts slide and part, differences of rounding grow.
  EXPECT_LT(behind, 3e-5 * 100e3);
}

}  // namespace
}  // namespace polargrain::testing
