// SPDX-License-Identifier: GPL-2.0-or-later
// Kills of the coordinator while LIGGGHTS runs in its workers.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/faults/checkpoint_runs.hpp"

namespace polargrain::testing {
namespace {

TEST(KilledCoordinators, OfRealGrainsLeaveRunsThatGoOnToTheSameBytes) {
  const Scratch scratch("checkpoint_grains");
  std::filesystem::copy(std::filesystem::path(POLARGRAIN_SOURCE_DIRECTORY) / "cases/biaxial",
                        scratch.path() / "biaxial");
  const std::string arguments =
      "run biaxial/case.yaml --quiet --set mesh.rectangle.elements=[2,4] --set steps.count=12 "
      "--set boundary.1.move.u2=-9.6mm";
  const Outcome whole = run_in(scratch.path(), POLARGRAIN " " + arguments + " -o whole -w 2");
  ASSERT_EQ(whole.status, 0) << whole.errors;
  const std::string expected = results_of(scratch.path() / "whole");
  const Kills done = kill_again_and_again(scratch.path(), arguments, 30, 20260102,
                                          [&](int status, const std::filesystem::path& result) {
                                            EXPECT_EQ(status, 0) << content(scratch.path() / "program.out");
                                            EXPECT_TRUE(results_of(result) == expected) << result;
                                          });
  std::cout << "[figure] real grains: " << done.kills << " kills, " << done.before_the_first
            << " before the first checkpoint, " << done.resumed << " runs went on from one, "
            << done.runs_finished + 1 << " came to their end\n";
  EXPECT_GE(done.resumed, 10);
}

}  // namespace
}  // namespace polargrain::testing
