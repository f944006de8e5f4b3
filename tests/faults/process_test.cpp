// SPDX-License-Identifier: GPL-2.0-or-later
// The effects of the system on a run: closed streams, pipes nobody reads, files that may not grow, directories that go away,
// signals in a hurry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/faults/checkpoint_runs.hpp"

namespace polargrain::testing {
namespace {

class ProcessFaults : public ::testing::Test {
 protected:
  ProcessFaults()
      : scratch_(std::string("process_") + ::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    write_case(scratch_.path(), {"sleep_milliseconds 4"});
  }
  /// Runs a command of the shell in the scratch directory; $P is the program.
  [[nodiscard]] Outcome shell(const std::string& command) const {
    return run_in(scratch_.path(), "P=" POLARGRAIN "; " + command);
  }
  [[nodiscard]] std::string result(const std::string& file) const { return content(scratch_.path() / file); }
  /// A run with one worker into out/ that a signal has stopped behind so many steps.
  [[nodiscard]] std::unique_ptr<RunningProgram> frozen(int steps) const {
    return frozen_behind(scratch_.path(), steps, "-w 1");
  }
  Scratch scratch_;
};

TEST_F(ProcessFaults, ClosedStreamsLeaveTheResultsAlone) {
  ASSERT_EQ(shell("$P run case.yaml -o whole -w 1").status, 0);
  // All ways to close some of the three: whatever is opened first must not get one of their numbers.
  for (const std::string closed : {"<&-", ">&-", "2>&-", "<&- >&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
    SCOPED_TRACE(closed);
    std::filesystem::remove_all(scratch_.path() / "out");
    EXPECT_EQ(shell("( exec $P run case.yaml -o out -w 1 " + closed + " )").status, 0);
    EXPECT_TRUE(results_of(scratch_.path() / "out") == results_of(scratch_.path() / "whole"));
    const std::string costs = result("out/costs.csv");
    EXPECT_EQ(std::count(costs.begin(), costs.end(), '\n'), 12) << costs;
    EXPECT_EQ(costs.find("step "), std::string::npos) << costs;
    EXPECT_EQ(result("out/run.log").find("step 1/10"), std::string::npos);
  }
}

TEST_F(ProcessFaults, ADirectoryThatIsRenamedEndsTheRunWithACheckpoint) {
  ASSERT_EQ(shell("$P run case.yaml -o whole -w 1 --quiet").status, 0);
  const auto program = frozen(2);
  std::filesystem::rename(scratch_.path() / "out", scratch_.path() / "moved");
  EXPECT_EQ(program->end(SIGCONT), 1);
  const std::string said = result("program.out");
  EXPECT_NE(said.find("the result directory out was renamed to "), std::string::npos) << said;
  EXPECT_NE(said.find("moved --resume"), std::string::npos) << said;
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "out"));
  EXPECT_NE(result("moved/summary.json").find("\"status\": \"failed\""), std::string::npos);
  EXPECT_EQ(shell("$P run case.yaml -o moved -w 1 --quiet --resume").status, 0);
  EXPECT_TRUE(results_of(scratch_.path() / "moved") == results_of(scratch_.path() / "whole"));
}

TEST_F(ProcessFaults, ADirectoryThatIsRemovedEndsTheRunWithACheckpoint) {
  ASSERT_EQ(shell("$P run case.yaml -o whole -w 1 --quiet").status, 0);
  const auto program = frozen(2);  // so that it finds all of it gone, not a part
  std::filesystem::remove_all(scratch_.path() / "out");
  EXPECT_EQ(program->end(SIGCONT), 1);
  const std::string said = result("program.out");
  EXPECT_NE(said.find("the result directory out was removed during the run"), std::string::npos) << said;
  EXPECT_NE(said.find("polargrain run case.yaml -o out --resume"), std::string::npos) << said;
  EXPECT_EQ(shell("$P run case.yaml -o out -w 1 --quiet --resume").status, 0);
  EXPECT_TRUE(result("out/history.csv") == result("whole/history.csv"));
}

TEST_F(ProcessFaults, NobodyListeningEndsNoRun) {
  ASSERT_EQ(shell("$P run case.yaml -o whole -w 1 --quiet").status, 0);
  ASSERT_EQ(shell("( $P run case.yaml -o pipe -w 1 2>&1; echo $? > status ) | true").status, 0);
  EXPECT_EQ(result("status"), "0\n");
  EXPECT_TRUE(results_of(scratch_.path() / "pipe") == results_of(scratch_.path() / "whole"));
  EXPECT_EQ(shell("$P run case.yaml -o full -w 1 > /dev/full 2> /dev/full").status, 0);
  EXPECT_TRUE(results_of(scratch_.path() / "full") == results_of(scratch_.path() / "whole"));
}

TEST_F(ProcessFaults, AnAnswerThatNobodyGetsIsAFailure) {
  EXPECT_EQ(shell("$P check case.yaml > /dev/full").status, 1);
  EXPECT_EQ(shell("$P check missing.yaml > /dev/full 2> /dev/full").status, 2);
  write(scratch_.path() / "path.csv", "h22\n-1e-4\n-1e-4\n");
  EXPECT_EQ(shell("$P point case.yaml sand path.csv > /dev/full 2> /dev/full").status, 1);
}

TEST_F(ProcessFaults, AFileThatMayNotGrowStopsTheRunWithAMessage) {
  // Blocks of 512 bytes: some rows, no fields.
  const Outcome outcome = shell("ulimit -f 8; $P run case.yaml -o out -w 1 --quiet");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.errors.find("cannot be written: File too large"), std::string::npos) << outcome.errors;
}

TEST_F(ProcessFaults, TwoSignalsAtOnceAreOneWish) {
  const auto program = frozen(2);
  kill(program->id(), SIGTERM);
  kill(program->id(), SIGCONT);
  // Signals of a kind that have not arrived are one: the second is sent when the first one has.
  while (program->running() && has_pending_signal(program->id())) sleep_for(0.001);
  EXPECT_EQ(program->end(SIGTERM), 3);
  const std::string said = result("program.out");
  EXPECT_EQ(said.find("stopped by SIGTERM\n"), 0u) << said;
  EXPECT_NE(said.find("to go on:\n  polargrain run case.yaml -o out --resume"), std::string::npos) << said;
  EXPECT_EQ(shell("$P run case.yaml -o out -w 1 --quiet --resume").status, 0);
}

TEST_F(ProcessFaults, WorkersGainNoRightsAndLeaveNoCore) {
  const auto program = frozen(1);
  const std::vector<pid_t> workers = children_of(program->id());
  ASSERT_EQ(workers.size(), 1u);
  const std::filesystem::path of_worker = "/proc/" + std::to_string(workers.front());
  EXPECT_NE(content(of_worker / "status").find("NoNewPrivs:\t1"), std::string::npos);
  const std::string limits = content(of_worker / "limits");
  EXPECT_EQ(limits.compare(limits.find("Max core file size"), 28, "Max core file size        0 "), 0)
      << limits;
}

TEST_F(ProcessFaults, SecondsAgreeWithTheirPartsAndWithTheCells) {
  const auto expect_agreement = [this] {
    const std::string summary = result("out/summary.json");
    const auto value = [&summary](const std::string& key) {
      return std::strtod(summary.c_str() + summary.find('"' + key + "\": ") + key.size() + 4, nullptr);
    };
    const double total = value("total");
    EXPECT_NEAR(
        value("grains") + value("messages") + value("waiting") + value("finite_elements") + value("rest"),
        total, 1e-9 * total);
    // One worker, which is there all the time: what its engine took is what grains took, to the digits written.
    EXPECT_GT(value("engine_seconds"), 0.0);
    EXPECT_NEAR(value("grains") / value("engine_seconds"), 1.0, 1e-5);
  };
  const auto program = frozen(2);
  kill(program->id(), SIGCONT);
  sleep_for(0.02);  // into a step
  EXPECT_EQ(program->end(SIGTERM), 3);
  expect_agreement();
  ASSERT_EQ(shell("$P run case.yaml -o out -w 1 --quiet --resume").status, 0);
  expect_agreement();
}

TEST_F(ProcessFaults, WhatNoMachineHoldsIsRefusedWithTheMemoryItWouldTake) {
  const Outcome elements = shell("$P check case.yaml --set 'mesh.rectangle.elements=[100000, 100000]'");
  EXPECT_EQ(elements.status, 2);
  EXPECT_NE(elements.errors.find(
                "elements: 10000000000 of them would take 650000 GB of memory; at most 1000000 are taken"),
            std::string::npos)
      << elements.errors;
  const Outcome steps = shell("$P check case.yaml --set steps.count=2000000000");
  EXPECT_EQ(steps.status, 2);
  EXPECT_NE(steps.errors.find("count: 2000000000 steps would take 2000 GB of memory"), std::string::npos)
      << steps.errors;
  // Stages count together.
  const Outcome stages = shell(
      "$P check case.yaml --set 'steps={stages: [{until: 0.5, count: 600000}, {until: 1, count: 600000}]}'");
  EXPECT_EQ(stages.status, 2);
  EXPECT_NE(stages.errors.find("count: 1200000 steps would take"), std::string::npos) << stages.errors;
}

}  // namespace
}  // namespace polargrain::testing
