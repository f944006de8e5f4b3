// SPDX-License-Identifier: GPL-2.0-or-later
// Ready cases without grains, and ways of stepping that only a case file can ask for, run as a user would.
#include <gtest/gtest.h>

#include <iostream>
#include <vector>

#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

class ReadyCase : public ::testing::Test {
 protected:
  Scratch scratch_{"ready_case"};

  Outcome run(const std::string& file) {
    return run_in(scratch_.path(), std::string(FAKE_POLARGRAIN " run '") + file + "' --quiet -o out");
  }
};

/// The base carries the weight, the surcharge and the load on the footing; the tolerance of the case
/// is 1e-6 of the loads.
TEST_F(ReadyCase, FootingBearsLoadAndStaysInBalance) {
  const Outcome outcome = run(POLARGRAIN_SOURCE_DIRECTORY "/cases/footing/case.yaml");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const CsvTable columns(scratch_.path() / "out/history.csv");
  const auto pressure = columns.numbers("pressure");
  const auto base_force = columns.numbers("base_force");
  const double weight = 6.0 * 4.0 * 18e3 + 5.0 * 10e3;
  for (std::size_t step = 0; step < pressure.size(); ++step) {
    EXPECT_NEAR(base_force[step], weight + pressure[step], 1e-6 * 5e6);
  }
  EXPECT_EQ(columns.numbers("iterations").front(), 0.0);  // the initial stress balances the weight
  EXPECT_NEAR(pressure.front(), 10e3, 1.0);
  // Terzaghi's formula with factors of Prandtl, Reissner and Vesic for 25 deg: 20.72 c + 10.66 q + 10.88
  // gamma B/2. Settlement, the internal length and the dilatancy below the friction move the figure; hence a
  // bracket only.
  const double bearing = 20.72 * 15e3 + 10.66 * 10e3 + 10.88 * 18e3 * 1.0;
  std::cout << "[figure] footing at 8 cm: " << pressure.back() << " Pa, Terzaghi " << bearing << " Pa\n";
  EXPECT_GT(pressure.back(), 0.8 * bearing);
  EXPECT_LT(pressure.back(), 1.2 * bearing);
}

TEST_F(ReadyCase, SlopeCarriesItsWeightAndYieldsUnderTheLoad) {
  const Outcome outcome = run(POLARGRAIN_SOURCE_DIRECTORY "/cases/slope/case.yaml");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const CsvTable columns(scratch_.path() / "out/history.csv");
  const double area = 18.0 * 3.0 + 8.0 * 5.0 + 0.5 * 5.0 * 5.0;
  EXPECT_NEAR(columns.numbers("base_force")[4], area * 18e3, 1e-6 * area * 18e3);
  EXPECT_NEAR(columns.numbers("base_force").back(), area * 18e3 + 3.0 * 150e3, 1e-6 * area * 18e3);
  const auto settlement = columns.numbers("crest_settlement");
  // The last of ten equal steps of the load settles more than the first, which is elastic.
  const double first = settlement[5] - settlement[4];
  const double last = settlement.back() - settlement[settlement.size() - 2];
  std::cout << "[figure] settlement of the last load step over the first: " << last / first << "\n";
  EXPECT_LT(first, 0.0);
  EXPECT_GT(last / first, 1.2);
}

/// An elastic block under a traction that grows with time: all ways of stepping follow the same straight
/// path, so the time they find is known. Solutions of linear equations agree to about 1e-12.
TEST_F(ReadyCase, MeasureAndArcLengthFindTheTime) {
  const std::string text = R"(title: Elastic block
mesh: {rectangle: {size: [1, 2], elements: [1, 2]}}
materials: {rock: {model: elastic, E: 1 GPa, nu: 0.2, Gc: 0.2 GPa, lc: 0}}
regions: {all: rock}
boundary:
  - {on: bottom, fix: [u2]}
  - {on: bottom_left, fix: [u1]}
  - {on: top, traction: {u2: [[0, 0], [10, 10 MPa]]}}
steps:
  tolerance: 1e-10
  stages:
    - {until: 0.5, count: 2}
    - {measure: {on: top, from: bottom, displacement: u2}, grow: 0.96 mm, count: 3}
    - {arc_length: 1 mm, count: 4}
monitors: {length: {on: top, displacement: u2}}
)";
  write(scratch_.path() / "case.yaml", text);
  const Outcome outcome = run("case.yaml");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const CsvTable columns(scratch_.path() / "out/history.csv");
  const auto time = columns.numbers("time");
  ASSERT_EQ(time.size(), 10U);
  // Plane strain: u2 = s22 (1 - nu^2) / E * 2 m, that is 1.92 mm a unit of time.
  EXPECT_NEAR(columns.numbers("length")[2], 0.5 * 1.92e-3, 1e-12);
  EXPECT_NEAR(time[5], 1.0, 1e-9);
  for (std::size_t step = 6; step < time.size(); ++step) {
    EXPECT_NEAR(time[step] - time[step - 1], time[6] - time[5], 1e-9);
    EXPECT_GT(time[step], time[step - 1]);
  }
}

}  // namespace
}  // namespace polargrain::testing
