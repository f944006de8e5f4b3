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
  std::string model;   ///< and its keys
  int kills;
};

void PrintTo(const KilledCase& killed, std::ostream* out) {
  *out << killed.name;
}

class KilledCoordinators : public ::testing::TestWithParam<KilledCase> {};

TEST_P(KilledCoordinators, LeaveRunsThatGoOnToTheSameBytes) {
  const KilledCase& killed = GetParam();
  const Scratch scratch("checkpoint_kill_" + killed.name);
  write_case(scratch.path(), {"sleep_milliseconds 1\n" + killed.engine, "[2, 2]",
                              "count: 12, tolerance: 1e-6", killed.model, "{every: 2}"});
  const Outcome whole = run_in(scratch.path(), POLARGRAIN " run case.yaml -o whole -w 2 --quiet");
  ASSERT_EQ(whole.status, 0) << whole.errors;
  const std::string expected = results_of(scratch.path() / "whole");
  ASSERT_GT(std::count(expected.begin(), expected.end(), '\n'), 100);
  const Kills done = kill_again_and_again(scratch.path(), "run case.yaml --quiet", killed.kills, 20260101,
                                          [&](int status, const std::filesystem::path& result) {
                                            EXPECT_EQ(status, 0) << content(scratch.path() / "program.out");
                                            EXPECT_TRUE(results_of(result) == expected) << result;
                                            const std::string costs = content(result / "costs.csv");
                                            EXPECT_EQ(std::count(costs.begin(), costs.end(), '\n'),
                                                      14);  // names, steps 0 to 12
                                          });
  std::cout << "[figure] " << done.kills << " kills, " << done.before_the_first
            << " of them before the first checkpoint, " << done.resumed << " runs went on from one, "
            << done.runs_finished + 1 << " came to their end\n";
  EXPECT_EQ(done.kills, killed.kills);
  EXPECT_GE(done.resumed, killed.kills / 3);
}

// Cells with softening and cuts: the increments that the fake takes are less than half a step.
INSTANTIATE_TEST_SUITE_P(Models, KilledCoordinators,
                         ::testing::Values(KilledCase{"cell", "fail_beyond 4.5e-4", "cell", 30},
                                           KilledCase{"adaptive", "softening 0.05",
                                                      "adaptive, adaptive: {tolerance: 1 %, audit: 20 %}",
                                                      30},
                                           KilledCase{"informed", "", "informed, informed: {nu: 0.25}", 30}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace polargrain::testing
