// SPDX-License-Identifier: GPL-2.0-or-later
// Whole runs of adaptive cases, with a fake engine whose stiffness falls as the shear stress grows.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

class AdaptiveRunTest : public ::testing::Test {
 protected:
  AdaptiveRunTest() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    write(directory() / "fake.in", "softening 0.05\n");
    write(directory() / "grains.csv",
          "# cell xx=0.1 xy=0 yx=0 yy=0.1 z=0.1\nid,x,y,r,mass,Izz\n1,0.05,0.05,0.04,1.0,8e-4\n");
    write_case("adaptive, adaptive: {tolerance: 1 %, audit: 5 %}");
  }

  void write_case(const std::string& model) {
    write(directory() / "case.yaml",
          "title: Compression of a fake between rough plates\n"
          "mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [4, 8]}}\n"
          "materials:\n  sand: {model: " +
              model +
              ", script: fake.in, packing: grains.csv, G: 40 MPa, Gc: 10 MPa, lc: 20 mm}\n"
              "regions: {all: sand}\n"
              "boundary:\n"
              "  - {on: bottom, fix: [u1, u2]}\n"
              "  - {on: top, fix: [u1], move: {u2: -8 mm}}\n"
              "  - {on: [left, right], pressure: 100 kPa}\n"
              "steps: {count: 8, tolerance: 1e-6}\n"
              "monitors:\n"
              "  top_force: {on: top, reaction: u2}\n"
              "  shortening: {on: top, displacement: u2}\n"
              "output: {every: 4, table: [shortening, top_force]}\n");
  }

  [[nodiscard]] const std::filesystem::path& directory() const { return scratch_.path(); }
  [[nodiscard]] Outcome polargrain(const std::string& arguments) const {
    return run_in(directory(), FAKE_POLARGRAIN " " + arguments);
  }
  [[nodiscard]] std::string result(const std::string& file) const { return content(directory() / file); }

  /// A number of summary.json.
  [[nodiscard]] double figure(const std::string& run, const std::string& name) const {
    const std::string text = result(run + "/summary.json");
    const std::size_t place = text.find("\"" + name + "\": ");
    EXPECT_NE(place, std::string::npos) << name;
    return place == std::string::npos ? NAN : std::stod(text.substr(place + name.size() + 4));
  }

  Scratch scratch_;
};

TEST_F(AdaptiveRunTest, IsCloseToTheFullRunForAFractionOfItsEvaluations) {
  const Outcome adaptive = polargrain("run case.yaml -o adaptive -w 2");
  ASSERT_EQ(adaptive.status, 0) << adaptive.errors;
  write_case("cell");
  ASSERT_EQ(polargrain("run case.yaml -o full -w 2").status, 0);
  const double full = figure("full", "top_force");
  const double error = std::abs(figure("adaptive", "top_force") - full) / std::abs(full);
  const double ratio = figure("full", "dem_steps") / figure("adaptive", "dem_steps");
  std::cout << "[figure] top force within " << error << ", " << ratio << " times fewer DEM steps\n";
  // The tolerance is 1 % of the confining pressure at a point, and the mean axial stress is above that.
  EXPECT_LT(error, 0.01);
  EXPECT_GT(ratio, 3.0);
  EXPECT_NE(adaptive.out.find("error_bound"), std::string::npos) << adaptive.out;
  EXPECT_GT(figure("adaptive", "history_errors"), 0.0);
  EXPECT_LT(figure("adaptive", "error_bound"), 0.02);
}

// A tolerance far above what carrying makes is met; without audits nobody can say so, and the run says that.
TEST_F(AdaptiveRunTest, WhatCannotBeVouchedForIsSaidInTheTableTheSummaryAndTheExitMessage) {
  write_case("adaptive, adaptive: {tolerance: 1 %, audit: 0}");
  const Outcome outcome = polargrain("run case.yaml -o blind -w 2");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const std::string words = "the error of its stresses is unknown";
  for (const std::string& text :
       {outcome.out, outcome.errors, result("blind/summary.json"), result("blind/run.log")})
    EXPECT_NE(text.find(words), std::string::npos) << text;
}

// 1 % of 100 kPa is 0.5 % of 200 kPa: the same decisions and the same digits.
TEST_F(AdaptiveRunTest, AToleranceIsAShareOfTheReferencePressure) {
  ASSERT_EQ(polargrain("run case.yaml -o own -w 2").status, 0);
  write_case("adaptive, adaptive: {tolerance: 0.5 %, audit: 5 %, reference_pressure: 200 kPa}");
  const Outcome outcome = polargrain("run case.yaml -o stated -w 2");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_EQ(result("own/history.csv"), result("stated/history.csv"));
  EXPECT_EQ(figure("own", "cell_runs"), figure("stated", "cell_runs"));
  // Shares of twice the pressure; the fake's packing carries 100 kPa but for rounding.
  EXPECT_NEAR(figure("stated", "error_bound"), 0.5 * figure("own", "error_bound"),
              1e-9 * figure("own", "error_bound"));
  write_case("adaptive, adaptive: {reference_pressure: 0}");
  EXPECT_NE(polargrain("check case.yaml").errors.find("reference_pressure: "), std::string::npos);
}

TEST_F(AdaptiveRunTest, OneAndTwoWorkersDecideAlike) {
  ASSERT_EQ(polargrain("run case.yaml -o one -w 1").status, 0);
  ASSERT_EQ(polargrain("run case.yaml -o two -w 2").status, 0);
  EXPECT_EQ(result("one/history.csv"), result("two/history.csv"));
  EXPECT_EQ(result("one/fields/step-00008.vtu"), result("two/fields/step-00008.vtu"));
  EXPECT_EQ(figure("one", "cell_runs"), figure("two", "cell_runs"));
  EXPECT_EQ(figure("one", "history_error_mean"), figure("two", "history_error_mean"));
  EXPECT_GT(result("one/history.csv").size(), 500u);
}

TEST_F(AdaptiveRunTest, FaultsOfItsKeysAreToldWithTheirLine) {
  write_case("adaptive, adaptive: {tolerance: -1, audit: 2}, tangent: voigt");
  const Outcome outcome = polargrain("check case.yaml");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.errors.find("case.yaml:4: "), std::string::npos) << outcome.errors;
  for (const char* words : {"tolerance: ", "at most 1 (100 %)", "leave the key out"}) {
    EXPECT_NE(outcome.errors.find(words), std::string::npos) << words << '\n' << outcome.errors;
  }
}

}  // namespace
}  // namespace polargrain::testing
