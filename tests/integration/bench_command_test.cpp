// SPDX-License-Identifier: GPL-2.0-or-later
// The command bench: its arithmetic on known curves, and the whole program over local and fake materials.
#include <gtest/gtest.h>

#include <iostream>

#include "coupler/commands/bench_page.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::coupler {
namespace {

using testing::content;
using testing::Outcome;
using testing::run_in;

TEST(BenchErrors, AreThoseOfKnownCurves) {
  const BenchCurve reference{{0.0, 1.0, 2.0}, {0.0, 10.0, 20.0}};
  const BenchCurve curve{{0.0, 0.5, 1.5, 2.0}, {0.0, 6.0, 15.0, 18.0}};
  // Largest differences: 1 at 0.5, 2 at the end; the range is 20. Peaks 18 and 20.
  const BenchError error = error_of(curve, reference);
  EXPECT_DOUBLE_EQ(error.largest, 0.1);
  EXPECT_DOUBLE_EQ(error.peak, 0.1);
  EXPECT_DOUBLE_EQ(reference.at(1.25), 12.5);
  // A run that goes further than the reference is compared as far as both go.
  EXPECT_DOUBLE_EQ(error_of({{0.0, 1.0, 5.0}, {0.0, 10.0, 99.0}}, reference).largest, 0.0);
  // Compression: x falls.
  EXPECT_DOUBLE_EQ(BenchCurve({{0.0, -1.0}, {0.0, 4.0}}).at(-0.5), 2.0);
}

BenchResult result(double seconds, double error, const std::string& status) {
  return {{}, status, 1, seconds, 0.0, 0.0, {{{0.0, 1.0}, {0.0, 1.0 + error}}}, {}, false};
}

TEST(BenchFront, HoldsWhatNothingBeats) {
  std::vector<BenchResult> results{result(100.0, 0.0, "done"), result(10.0, 0.02, "done"),
                                   result(20.0, 0.03, "done"), result(30.0, 0.01, "done"),
                                   result(1.0, 0.001, "stopped")};
  compare(results);
  EXPECT_FALSE(results[0].on_front) << "the reference has no error to be judged by";
  EXPECT_TRUE(results[1].on_front);
  EXPECT_FALSE(results[2].on_front) << "slower and farther than the first";
  EXPECT_TRUE(results[3].on_front);
  EXPECT_FALSE(results[4].on_front) << "it has not come to its end";
}

class BenchCommandTest : public ::testing::Test {
 protected:
  BenchCommandTest() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    testing::write(directory() / "fake.in", "softening 0.05\n");
    testing::write(directory() / "grains.csv",
                   "# cell xx=0.1 xy=0 yx=0 yy=0.1 z=0.1\nid,x,y,r,mass,Izz\n1,0.05,0.05,0.04,1.0,8e-4\n");
    write_case("case.yaml",
               "{model: cell, script: fake.in, packing: grains.csv, G: 40 MPa, Gc: 10 MPa, lc: 20 mm}");
    write_case("law.yaml",
               "{model: elastic, E: 100 MPa, nu: 0.25, Gc: 10 MPa, lc: 20 mm, confining: 100 kPa}");
  }
  void write_case(const std::string& name, const std::string& sand) {
    testing::write(directory() / name,
                   "title: Compression of a fake\n"
                   "mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [1, 2]}}\n"
                   "materials:\n  sand: " +
                       sand +
                       "\nregions: {all: sand}\n"
                       "boundary:\n"
                       "  - {on: bottom, fix: [u1, u2]}\n"
                       "  - {on: top, fix: [u1], move: {u2: -8 mm}}\n"
                       "  - {on: [left, right], pressure: 100 kPa}\n"
                       "steps: {count: 8, tolerance: 1e-6}\n"
                       "monitors:\n"
                       "  force: {on: top, reaction: u2}\n"
                       "  shortening: {on: top, displacement: u2}\n"
                       "output: {table: [shortening, force, volume_strain]}\n");
  }
  [[nodiscard]] const std::filesystem::path& directory() const { return scratch_.path(); }
  [[nodiscard]] Outcome polargrain(const std::string& arguments) const {
    return run_in(directory(), FAKE_POLARGRAIN " " + arguments);
  }
  testing::Scratch scratch_;
};

TEST_F(BenchCommandTest, MeasuresTheGridAndWritesItsPages) {
  const Outcome outcome = polargrain("bench case.yaml law.yaml --quick -o out -w 1");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const std::string csv = content(directory() / "out/bench.csv");
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "case,what,setting,status,steps,seconds,cell_evaluations,dem_steps,error_force,peak_error_force,"
            "error_volume_strain,peak_error_volume_strain,front");
  for (const char* group : {",reference,", ",as given,", ",scheme,law.yaml,", ",equilibrium,",
                            ",loading rate,", ",adaptivity,tolerance 10 %,", ",step size,4 steps,"}) {
    EXPECT_NE(csv.find(group), std::string::npos) << group << '\n' << csv;
  }
  const std::string page = content(directory() / "out/bench.html");
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_NE(page.find("Speed against error: Compression of a fake"), std::string::npos);
  EXPECT_EQ(page.find("src="), std::string::npos) << "the page must stand alone";
  EXPECT_NE(outcome.errors.find("run 2 of "), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.errors.find(" left"), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.out.find("| as given |"), std::string::npos) << outcome.out;
}

TEST_F(BenchCommandTest, AnErrorOfAKnownSizeIsMeasured) {
  // The same elastic law, 1 % stiffer: the force above the confining one grows by 1 %, and so does its range.
  const Outcome outcome =
      polargrain("bench law.yaml --vary materials.sand.E=100e6,101e6 -o out -w 1 --y force");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const std::string csv = content(directory() / "out/bench.csv");
  const auto error_of_row = [&](const std::string& setting) {
    const std::size_t row = csv.find("," + setting + ",done,8,");
    EXPECT_NE(row, std::string::npos) << csv;
    std::istringstream cells(csv.substr(row + 1));
    std::string cell;
    for (int k = 0; k < 7; ++k) std::getline(cells, cell, ',');
    return std::stod(cell);
  };
  std::cout << "[figure] 1 % of stiffness measured as " << error_of_row("101e6") << '\n';
  // The reference takes twice the steps of a linear law: no difference but that of the tolerance, 1e-6. The
  // moduli Gc and the confinement do not scale, which leaves a few per cent of the 1 %.
  EXPECT_LT(error_of_row("100e6"), 1e-5);
  EXPECT_NEAR(error_of_row("101e6"), 0.01, 1e-3);
}

TEST_F(BenchCommandTest, NothingRunsWhenACaseIsWrong) {
  write_case("wrong.yaml", "{model: elastic, E: -1, nu: 0.25, Gc: 10 MPa, lc: 20 mm}");
  const Outcome outcome = polargrain("bench law.yaml wrong.yaml -o out");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.errors.find("wrong.yaml:4: "), std::string::npos) << outcome.errors;
  EXPECT_FALSE(std::filesystem::exists(directory() / "out"));
  EXPECT_EQ(polargrain("bench law.yaml -o out --vary materials.sand.E").status, 2);
  EXPECT_EQ(polargrain("bench law.yaml -o out --y nothing").status, 2);
  EXPECT_FALSE(std::filesystem::exists(directory() / "out"));
}

}  // namespace
}  // namespace polargrain::coupler
