// SPDX-License-Identifier: GPL-2.0-or-later
// The demo with real grains on a coarser mesh, a hundred of its workers killed meanwhile.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/faults/killer.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

TEST(EngineKillsTest, AHundredKilledWorkersChangeNothing) {
  const Scratch scratch("engine_kills");
  const std::string command = POLARGRAIN " run " POLARGRAIN_SOURCE_DIRECTORY
                                         "/cases/biaxial/case.yaml --set mesh.rectangle.elements=[2,4] "
                                         "--set steps.count=40 -w 2 --quiet -o ";  // 0.35 of them a kill
  const Outcome quiet = run_in(scratch.path(), command + "quiet");
  ASSERT_EQ(quiet.status, 0) << quiet.errors;
  Beside run("env -C '" + scratch.path().string() + "' " + command + "disturbed");
  const int kills = kill_workers(run, scratch.path() / "disturbed/history.csv", 100, 0.35, 20250103).sent;
  EXPECT_EQ(run.wait(), 0);
  EXPECT_EQ(kills, 100);
  EXPECT_EQ(content(scratch.path() / "disturbed/history.csv"), content(scratch.path() / "quiet/history.csv"));
  EXPECT_GT(content(scratch.path() / "quiet/history.csv").size(), 1000u);
}

}  // namespace
}  // namespace polargrain::testing
