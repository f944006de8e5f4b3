// SPDX-License-Identifier: GPL-2.0-or-later
// The coordinator is killed at random moments; each time the run goes on from its checkpoint.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "tests/faults/checkpoint_runs.hpp"

namespace polargrain::testing {
namespace {

/// A material, its engine and how often its runs are killed.
struct KilledCase {
  std::string name;
  std::string engine;  ///< script of the fake engine
  std::string material;
  int kills;
};

void PrintTo(const KilledCase& killed, std::ostream* out) {
  *out << killed.name;
}

class KilledCoordinators : public ::testing::TestWithParam<KilledCase> {};

TEST_P(KilledCoordinators, LeaveRunsThatGoOnToTheSameBytes) {
  const KilledCase& killed = GetParam();
  const Scratch scratch("checkpoint_kill_" + killed.name);
  write(scratch.path() / "fake.in", "sleep_milliseconds 1\n" + killed.engine + "\n");
  write(scratch.path() / "grains.csv",
        "# cell xx=0.1 xy=0 yx=0 yy=0.1 z=0.1\nid,x,y,r,mass,Izz\n1,0.05,0.05,0.04,1.0,8e-4\n");
  write(scratch.path() / "case.yaml",
        "title: A run that is killed\n"
        "mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [2, 2]}}\n"
        "materials: {sand: {" +
            killed.material +
            ", script: fake.in, packing: grains.csv, G: 40 MPa, Gc: 10 MPa, lc: 20 mm}}\n"
            "regions: {all: sand}\n"
            "boundary:\n"
            "  - {on: bottom, fix: [u1, u2]}\n"
            "  - {on: top, fix: [u1], move: {u2: -8 mm}}\n"
            "  - {on: [left, right], pressure: 100 kPa}\n"
            "steps: {count: 12, tolerance: 1e-6}\n"
            "monitors: {top_force: {on: top, reaction: u2}}\n"
            "output: {every: 2}\n");
  const auto begin = std::chrono::steady_clock::now();
  const Outcome whole = run_in(scratch.path(), POLARGRAIN " run case.yaml -o whole -w 2 --quiet");
  ASSERT_EQ(whole.status, 0) << whole.errors;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const std::string expected = results_of(scratch.path() / "whole");
  ASSERT_GT(std::count(expected.begin(), expected.end(), '\n'), 100);
  const Kills done = kill_again_and_again(
      scratch.path(), "run case.yaml --quiet", killed.kills, 20260101, 0.6 * seconds,
      [&](int status, const std::filesystem::path& result) {
        EXPECT_EQ(status, 0) << content(scratch.path() / "program.out");
        EXPECT_TRUE(results_of(result) == expected) << result;
        const std::string costs = content(result / "costs.csv");
        EXPECT_EQ(std::count(costs.begin(), costs.end(), '\n'), 14);  // names, steps 0 to 12
      });
  std::cout << "[figure] " << done.kills << " kills, " << done.before_the_first
            << " of them before the first checkpoint, " << done.resumed << " runs went on from one, "
            << done.runs_finished + 1 << " came to their end\n";
  EXPECT_EQ(done.kills, killed.kills);
  EXPECT_GE(done.resumed, killed.kills / 3);
}

// Cells with softening and cuts: the increments that the fake takes are less than half a step.
INSTANTIATE_TEST_SUITE_P(Models, KilledCoordinators,
                         ::testing::Values(KilledCase{"cell", "fail_beyond 4.5e-4", "model: cell", 30},
                                           KilledCase{"adaptive", "softening 0.05",
                                                      "model: adaptive, tolerance: 1 %, audit: 20 %", 30},
                                           KilledCase{"informed", "", "model: informed, nu: 0.25", 30}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace polargrain::testing
