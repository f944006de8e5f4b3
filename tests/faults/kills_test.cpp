// SPDX-License-Identifier: GPL-2.0-or-later
// Workers killed and stopped at random during whole runs: the results are those of the undisturbed run, to
// the bit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "tests/faults/fake_case.hpp"
#include "tests/faults/killer.hpp"

namespace polargrain::testing {
namespace {

class KillsTest : public FakeCaseTest {
 protected:
  [[nodiscard]] std::filesystem::path history() const { return disturbed() / "history.csv"; }
  [[nodiscard]] std::string log() const { return result("disturbed/run.log"); }
};

/// Steps of a run that even a killer with a fifteenth of the processor keeps up with.
constexpr int kLongestRun = 2700;

int count_of(const std::string& word, const std::string& text) {
  int count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

TEST_F(KillsTest, AHundredKilledWorkersChangeNothing) {
  int kills = 0;
  // On a busy machine the run gets ahead of who kills its workers: then a longer one is made.
  for (int steps = 100; kills < 100 && steps <= kLongestRun; steps *= 3) {
    Beside run(prepare(steps));
    const WorkerKills done = kill_workers(run, history(), 100, 1.0, 20250101, steps + 2);
    kills = done.sent;
    EXPECT_EQ(run.wait(), 0);
    EXPECT_EQ(result("disturbed/history.csv"), result("quiet/history.csv"));
    const int told = count_of("killed by signal 9", log());
    std::cout << "[figure] workers killed " << kills << ", told " << told
              << ", cells that went to another worker " << count_of("its cell goes to another worker", log())
              << '\n';
    // Nobody notices a worker that is killed behind the last cell.
    EXPECT_GE(told, done.before_last_step) << log();
    EXPECT_LE(told, kills);
  }
  EXPECT_EQ(kills, 100);
}

// Neither which points run a cell nor what the audits find depends on who died.
TEST_F(KillsTest, KilledWorkersChangeNoDecisionOfAnAdaptiveRun) {
  int kills = 0;
  for (int steps = 100; kills < 30 && steps <= kLongestRun; steps *= 3) {
    Beside run(prepare(steps,
                       " --set materials.sand.model=adaptive --set materials.sand.adaptive.tolerance=0.01"
                       " --set materials.sand.adaptive.audit=0.5 --set steps.tolerance=1e-6"));
    kills = kill_workers(run, history(), 30, 3.0, 20250103).sent;
    EXPECT_EQ(run.wait(), 0);
    EXPECT_EQ(result("disturbed/history.csv"), result("quiet/history.csv"));
    const std::string last = fmt::format("fields/step-{:05}.vtu", steps);
    EXPECT_EQ(result("disturbed/" + last), result("quiet/" + last));
  }
  EXPECT_EQ(kills, 30);
}

TEST_F(KillsTest, StoppedWorkersChangeNothing) {
  Beside run(prepare(30, " --set workers.silence='1 s'"));
  const auto hangs = [this] {
    return count_of("it hangs: no sign of life for 1 s; a signal has stopped its process", log());
  };
  Pace pace(run, history());
  ASSERT_TRUE(pace.await(2));
  const std::vector<pid_t> workers = children_of(run.id());  // of the start: all have reported
  ASSERT_EQ(workers.size(), 3U);
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(pace.await(2 + 5 * k));
    pace.sleep_for_rows(0.3 * k);
    kill(workers[static_cast<std::size_t>(k)], SIGSTOP);
    // Who is stopped is noticed when there is work for it.
    EXPECT_TRUE(await(run, [&] { return hangs() > k; })) << log();
  }
  EXPECT_EQ(run.wait(), 0);
  EXPECT_EQ(result("disturbed/history.csv"), result("quiet/history.csv"));
  EXPECT_EQ(hangs(), 3) << log();
}

TEST_F(KillsTest, WorkersDelayedForLessThanTheLimitAreKept) {
  using Clock = std::chrono::steady_clock;
  Beside run(prepare(30));
  Pace pace(run, history());
  int too_long = 0;  // pauses that a busy machine made longer than the limit: they prove nothing
  int pauses = 0;
  while (pauses < 10 && pace.await(2 + pauses)) {
    const std::vector<pid_t> workers = children_of(run.id());
    if (workers.empty()) continue;
    const Clock::time_point begin = Clock::now();
    kill(workers.front(), SIGSTOP);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    kill(workers.front(), SIGCONT);
    ++pauses;
    if (Clock::now() - begin > std::chrono::milliseconds(1500)) ++too_long;
  }
  EXPECT_EQ(run.wait(), 0);
  EXPECT_EQ(pauses, 10);
  EXPECT_EQ(result("disturbed/history.csv"), result("quiet/history.csv"));
  EXPECT_LE(count_of("hangs", log()), too_long) << log();
}

TEST_F(KillsTest, ACoordinatorThatWasStoppedDoesNotBlameItsWorkers) {
  Beside run(prepare(30));
  ASSERT_TRUE(Pace(run, history()).await(4));
  kill(run.id(), SIGSTOP);
  std::this_thread::sleep_for(std::chrono::milliseconds(3500));
  kill(run.id(), SIGCONT);
  EXPECT_EQ(run.wait(), 0);
  EXPECT_EQ(result("disturbed/history.csv"), result("quiet/history.csv"));
  EXPECT_EQ(count_of("hangs", log()), 0) << log();
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
