// SPDX-License-Identifier: GPL-2.0-or-later
// Ground of boxes of grains that begins under its own weight.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>

#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::string kPacking = POLARGRAIN_SOURCE_DIRECTORY "/cases/footing_cells/packing100.h5";  // at 100 kPa
constexpr const char* kGround =
    "initial_stress: [{surface: 5 m, unit_weight: 18 kN/m3, K0: 0.6, surcharge: 50 kPa}]\n";

class GroundEngine : public ::testing::Test {
 protected:
  GroundEngine() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {}

  /// A column of 5 m under 50 kPa, then 55 kPa. @returns its history
  CsvTable run(const std::string& name, const std::string& model, const std::string& initial,
               const std::string& options) {
    write(scratch_.path() / (name + ".yaml"),
          "title: A column of ground\n"
          "mesh: {rectangle: {size: [1 m, 5 m], elements: [1, 3]}}\n"
          "materials:\n  sand: {model: " +
              model + ", script: cells/hooke_radii.in, packing: " + kPacking +
              ", lc: 8 mm}\n"
              "regions: {all: sand}\nboundary:\n"
              "  - {on: bottom, fix: [u2]}\n  - {on: [left, right], fix: [u1]}\n  - {on: all, fix: [w]}\n"
              "  - {on: top, pressure: [[0, 50 kPa], [1, 55 kPa]]}\n"
              "body: [{unit_weight: 18 kN/m3}]\n" +
              initial +
              "steps: {count: 1}\n"
              "monitors: {top: {on: top, displacement: u2}}\noutput: {every: 100, checkpoint_minutes: 0}\n");
    const Outcome outcome =
        run_in(scratch_.path(), POLARGRAIN " run " + name + ".yaml --quiet -o " + name + " " + options);
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    return CsvTable(scratch_.path() / name / "history.csv");
  }
  [[nodiscard]] double figure(const std::string& name, const std::string& key) const {
    return nlohmann::json::parse(content(scratch_.path() / name / "summary.json"))["materials"]["all"][key];
  }

  Scratch scratch_;
};

TEST_F(GroundEngine, BeginsAtRestInsteadOfSettlingInStepZero) {
  const double before = run("packing", "cell", "", "-w 2").numbers("top").front();
  const auto top = run("ground", "cell", kGround, "-w 1").numbers("top");
  std::cout << "[figure] step 0 moves the top by " << before << " m from the packing, by " << top.front()
            << " m from boxes at their depth; 5 kPa then settle it by " << top.front() - top.back() << " m\n";
  EXPECT_GT(std::abs(before), 1e-3);
  EXPECT_LT(std::abs(top.front()), 1e-3 * std::abs(before));
  EXPECT_LT(figure("ground", "start_stress_off_share"), 0.01);
  // The table is followed to 2e-3 of the vertical stress.
  EXPECT_NEAR(figure("ground", "start_K0_least"), 0.6, 0.01);
  EXPECT_LT(top.back(), top.front());
  // The same bytes of three workers.
  run("three", "cell", kGround, "-w 3");
  EXPECT_EQ(content(scratch_.path() / "ground/history.csv"), content(scratch_.path() / "three/history.csv"));
}

TEST_F(GroundEngine, AdaptiveBoxesBeginWithinTheirTolerance) {
  run("shared", "adaptive, adaptive: {tolerance: 2 %}", kGround, "-w 2");
  EXPECT_LT(figure("shared", "start_stress_off"), 0.05 * 100e3);
  EXPECT_LT(figure("shared", "cells"), 12.0);
}

}  // namespace
}  // namespace polargrain::testing
