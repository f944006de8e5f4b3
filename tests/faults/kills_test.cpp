// SPDX-License-Identifier: GPL-2.0-or-later
// Workers killed and stopped at random during whole runs: the results are those of the undisturbed run, to
// the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "tests/faults/fake_case.hpp"
#include "tests/faults/killer.hpp"

namespace polargrain::testing {
namespace {

class KillsTest : public FakeCaseTest {
 protected:
  /// Waits until the workers of the disturbed run have reported.
  void await_workers(Beside& run) const {
    while (run.running() && result("disturbed/run.log").find("workers started") == std::string::npos) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
};

int count_of(const std::string& word, const std::string& text) {
  int count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

TEST_F(KillsTest, AHundredKilledWorkersChangeNothing) {
  Beside run(prepare(100));
  const int kills = kill_workers(run, 100, 0.06, 20250101);
  EXPECT_EQ(run.wait(), 0);
  EXPECT_EQ(kills, 100);
  EXPECT_EQ(result("disturbed/history.csv"), result("quiet/history.csv"));
  const std::string log = result("disturbed/run.log");
  const int told = count_of("killed by signal 9", log);
  std::cout << "[figure] workers killed " << kills << ", told " << told
            << ", cells that went to another worker " << count_of("its cell goes to another worker", log)
            << '\n';
  // A process that is killed twice, or after the last cell, is told once or not at all.
  EXPECT_GE(told, 90);
  EXPECT_LE(told, 100);
}

// Neither which points run a cell nor what the audits find depends on who died.
TEST_F(KillsTest, KilledWorkersChangeNoDecisionOfAnAdaptiveRun) {
  Beside run(prepare(100,
                     " --set materials.sand.model=adaptive --set materials.sand.tolerance=0.01"
                     " --set materials.sand.audit=0.5 --set steps.tolerance=1e-6"));
  const int kills = kill_workers(run, 30, 0.03, 20250103);
  EXPECT_EQ(run.wait(), 0);
  EXPECT_GE(kills, 10);
  std::cout << "[figure] workers killed " << kills << '\n';
  EXPECT_EQ(result("disturbed/history.csv"), result("quiet/history.csv"));
  EXPECT_EQ(result("disturbed/fields/step-00100.vtu"), result("quiet/fields/step-00100.vtu"));
}

TEST_F(KillsTest, StoppedWorkersChangeNothing) {
  Beside run(prepare(30));
  await_workers(run);
  EXPECT_EQ(kill_workers(run, 5, 0.5, 20250102, SIGSTOP), 5);
  EXPECT_EQ(run.wait(), 0);
  EXPECT_EQ(result("disturbed/history.csv"), result("quiet/history.csv"));
  EXPECT_GE(count_of("it hangs: no sign of life for 2 s; a signal has stopped its process",
                     result("disturbed/run.log")),
            2);
}

TEST_F(KillsTest, WorkersDelayedForLessThanTheLimitAreKept) {
  Beside run(prepare(30));
  await_workers(run);
  for (int pause = 0; pause < 10 && run.running(); ++pause) {
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    const std::vector<pid_t> workers = children_of(run.id());
    if (workers.empty()) continue;
    kill(workers.front(), SIGSTOP);
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    kill(workers.front(), SIGCONT);
  }
  EXPECT_EQ(run.wait(), 0);
  EXPECT_EQ(result("disturbed/history.csv"), result("quiet/history.csv"));
  EXPECT_EQ(count_of("hangs", result("disturbed/run.log")), 0) << result("disturbed/run.log");
}

TEST_F(KillsTest, ACoordinatorThatWasStoppedDoesNotBlameItsWorkers) {
  Beside run(prepare(30));
  await_workers(run);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  kill(run.id(), SIGSTOP);
  std::this_thread::sleep_for(std::chrono::milliseconds(3500));
  kill(run.id(), SIGCONT);
  EXPECT_EQ(run.wait(), 0);
  EXPECT_EQ(result("disturbed/history.csv"), result("quiet/history.csv"));
  EXPECT_EQ(count_of("hangs", result("disturbed/run.log")), 0) << result("disturbed/run.log");
}

TEST_F(KillsTest, ACellThatFailsForEverLeavesAReplay) {
  write(scratch_.path() / "fake.in", "die_beyond 1e-5\n");
  const Outcome outcome = run_in(scratch_.path(), FAKE_POLARGRAIN
                                 " run case.yaml -o out -w 2 --quiet --set steps.cut=1 "
                                 "--set mesh.rectangle.elements=[1,1]");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.errors.find("the cell that failed can be run alone: see out/replay/README.md"),
            std::string::npos)
      << outcome.errors;
  EXPECT_NE(result("out/replay/README.md").find("ERROR: Lost atoms"), std::string::npos);
}

}  // namespace
}  // namespace polargrain::testing
