// SPDX-License-Identifier: GPL-2.0-or-later
// The fate of cells and workers that fail, hang or end.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>

#include "coupler/pool/private_directory.hpp"
#include "tests/integration/fake_engine.hpp"
#include "tests/integration/pool_fixture.hpp"
#include "tests/integration/random_requests.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/processes.hpp"

namespace polargrain::coupler {
namespace {

using testing::random_requests;

TEST_F(PoolTest, AFailedCellIsAnAnswer) {
  Pool pool(options(1));
  pool.define(testing::fake_definition("fail_beyond 0.1"));
  std::vector<PoolRequest> requests = random_requests(2);
  requests[1].cell.increment.displacement_gradient(0, 0) = 0.2;
  const std::vector<CellReply> replies = pool.evaluate(requests);
  EXPECT_EQ(replies[0].response.quality, Quality::good);
  EXPECT_EQ(replies[1].response.quality, Quality::failed);
  EXPECT_EQ(replies[1].response.message, "the box collapsed");
  EXPECT_EQ(replies[1].state, nullptr);
}

TEST_F(PoolTest, ACellThatEndsTwoWorkersHasFailedInTheEnginesWords) {
  Pool pool(options(1));
  pool.define(testing::fake_definition("die_beyond 0.1"));
  std::vector<PoolRequest> requests = random_requests(3);
  requests[1].cell.increment.displacement_gradient(0, 0) = 0.2;
  requests[1].point = 17;
  const std::vector<CellReply> replies = pool.evaluate(requests);
  EXPECT_EQ(replies[0].response.quality, Quality::good);
  EXPECT_EQ(replies[2].response.quality, Quality::good);
  EXPECT_EQ(replies[1].response.quality, Quality::failed);
  EXPECT_EQ(replies[1].response.step_factor, 0.5);
  EXPECT_EQ(replies[1].response.message,
            "worker 1 died at work on point 17 of material 'sand' (fake.in): exit status 1; its log " +
                log(1) + " says:\nERROR: Lost atoms: original 400 current 399 (../thermo.cpp:396)\n");
  // One more when the answer before was lost with the first worker: either cell may then be at fault.
  EXPECT_GE(pool.counts().workers_lost, 2);
  EXPECT_LE(pool.counts().workers_lost, 3);
  ASSERT_TRUE(pool.last_failure());
  EXPECT_EQ(pool.last_failure()->point, 17u);
  EXPECT_EQ(pool.last_failure()->request.increment.displacement_gradient(0, 0), 0.2);
}

TEST_F(PoolTest, NoCellIsBlamedForItsNeighbour) {
  // Many cells in a message, and several that end their workers.
  Pool pool(options(2));
  pool.define(testing::fake_definition("die_beyond 0.1"));
  pool.evaluate(random_requests(50));  // it has seen how fast they are
  std::vector<PoolRequest> requests = random_requests(300);
  const std::vector<CellReply> expected = pool.evaluate(requests);
  for (const std::size_t bad : {3, 4, 150, 299})
    requests[bad].cell.increment.displacement_gradient(0, 0) = 0.2;
  const std::vector<CellReply> replies = pool.evaluate(requests);
  for (std::size_t r = 0; r < 300; ++r) {
    const bool bad = r == 3 || r == 4 || r == 150 || r == 299;
    EXPECT_EQ(replies[r].response.quality, bad ? Quality::failed : Quality::good) << r;
    if (bad) continue;
    EXPECT_TRUE(same_bits(replies[r], expected[r])) << r;
  }
  EXPECT_EQ(pool.last_failure()->point, 3u);
}

TEST_F(PoolTest, ADefinitionThatEndsEveryWorkerIsTheUsersError) {
  Pool pool(options(2));
  const std::uint32_t sand = pool.define(testing::fake_definition("pear_style gran"));
  const std::string message = message_of([&] { pool.initial(sand); });
  EXPECT_NE(message.find("died at work on a cell of material 'sand' (fake.in): exit status 1"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("ERROR: Unknown command: pear_style (../input.cpp:209)"), std::string::npos)
      << message;
}

TEST_F(PoolTest, AKilledWorkerIsReplacedAndToldOnce) {
  PoolOptions quiet = options(1);
  std::vector<std::string> told;
  quiet.tell = [&](const std::string& text) { told.push_back(text); };
  Pool pool(quiet);
  pool.define(testing::fake_definition(""));
  const std::vector<CellReply> first = pool.evaluate(random_requests(5));
  ASSERT_EQ(kill(testing::children_of(getpid()).at(0), SIGKILL), 0);
  const std::vector<CellReply> second = pool.evaluate(random_requests(5));
  for (std::size_t r = 0; r < 5; ++r) EXPECT_TRUE(same_bits(first[r], second[r])) << r;
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].find("worker 1 died"), 0u) << told[0];
  EXPECT_NE(told[0].find("killed by signal 9 (Killed)"), std::string::npos) << told[0];
}

TEST_F(PoolTest, ARefusalNamesMaterialAndReason) {
  Pool pool(options(1));
  pool.define(testing::fake_definition("refuse_beyond 0.1"));
  std::vector<PoolRequest> requests = random_requests(1);
  requests[0].cell.increment.displacement_gradient(0, 0) = 0.2;
  const std::vector<CellReply> replies = pool.evaluate(requests);
  EXPECT_EQ(replies[0].response.quality, Quality::failed);
  EXPECT_EQ(replies[0].response.message,
            "worker 1 refuses point 0 of material 'sand' (fake.in): the increment is not to my liking");
}

TEST_F(PoolTest, AHungWorkerIsReplaced) {
  PoolOptions impatient = options(2);
  impatient.patience.silence_seconds = 0.5;
  std::vector<std::string> told;
  impatient.tell = [&](const std::string& text) { told.push_back(text); };
  Pool pool(impatient);
  pool.define(testing::fake_definition(""));
  const std::vector<CellReply> first = pool.evaluate(random_requests(20));
  ASSERT_EQ(kill(testing::children_of(getpid()).at(0), SIGSTOP), 0);
  const std::vector<CellReply> second = pool.evaluate(random_requests(20));
  for (std::size_t r = 0; r < 20; ++r) EXPECT_TRUE(same_bits(first[r], second[r])) << r;
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("it hangs: no sign of life for 0.5 s"), std::string::npos) << told[0];
  EXPECT_NE(told[0].find("of material 'sand'"), std::string::npos) << told[0];
}

TEST_F(PoolTest, ACellThatHangsTwoWorkersHasFailed) {
  PoolOptions impatient = options(2);
  impatient.patience.silence_seconds = 0.3;
  Pool pool(impatient);
  pool.define(testing::fake_definition("hang_beyond 0.1"));
  std::vector<PoolRequest> requests = random_requests(4);
  requests[0].cell.increment.displacement_gradient(0, 0) = 0.2;
  const std::vector<CellReply> replies = pool.evaluate(requests);
  EXPECT_EQ(replies[0].response.quality, Quality::failed);
  EXPECT_NE(replies[0].response.message.find("it hangs"), std::string::npos) << replies[0].response.message;
  for (std::size_t r = 1; r < 4; ++r) EXPECT_EQ(replies[r].response.quality, Quality::good);
}

TEST_F(PoolTest, ALongCellThatShowsLifeIsNoHang) {
  PoolOptions impatient = options(1);
  impatient.patience.silence_seconds = 0.3;
  Pool pool(impatient);
  pool.define(testing::fake_definition("sleep_milliseconds 1500"));
  EXPECT_EQ(pool.evaluate(random_requests(1))[0].response.quality, Quality::good);
  EXPECT_EQ(pool.counts().workers_lost, 0);
}

TEST_F(PoolTest, ACellThatNeverEndsIsGivenUpDespiteItsHeartbeats) {
  PoolOptions impatient = options(1);
  impatient.patience.cell_seconds = 0.5;
  Pool pool(impatient);
  pool.define(testing::fake_definition("sleep_milliseconds 60000"));
  const std::vector<CellReply> replies = pool.evaluate(random_requests(1));
  EXPECT_EQ(replies[0].response.quality, Quality::failed);
  EXPECT_NE(replies[0].response.message.find("the cell takes longer than 0.5 s"), std::string::npos)
      << replies[0].response.message;
}

TEST_F(PoolTest, WhenNoWorkerCanBeStartedAnyMoreTheRunEnds) {
  // A program that works once and is replaced by one that does not start.
  const std::filesystem::path program = directory_ / "worker";
  std::filesystem::create_symlink(FAKE_WORKER, program);
  PoolOptions fragile = options(1);
  fragile.worker_command = {program.string()};
  Pool pool(fragile);
  pool.define(testing::fake_definition(""));
  pool.evaluate(random_requests(1));
  std::filesystem::remove(program);
  ASSERT_EQ(kill(testing::children_of(getpid()).at(0), SIGKILL), 0);
  const std::string message = message_of([&] { pool.evaluate(random_requests(1)); });
  EXPECT_EQ(message.find("no worker is left: each was started several times; the last: worker 1 died before"),
            0u)
      << message;
  EXPECT_NE(message.find("cannot execute"), std::string::npos) << message;
}

TEST_F(PoolTest, AProgramThatCannotStartIsReported) {
  PoolOptions broken = options(1);
  broken.worker_command = {"/no/such/program"};
  EXPECT_EQ(message_of([&] { Pool pool(broken); }),
            "worker 1 died before it reported: exit status 127; its log " + log(1) +
                " says:\ncannot execute /no/such/program: No such file or directory\n");
}

TEST_F(PoolTest, AWorkerThatSaysNothingIsReported) {
  PoolOptions silent = options(1);
  silent.worker_command = {"/bin/sh", "-c", "echo thinking; sleep 60"};
  // Until it has said something, which a busy machine delays.
  std::string said;
  for (silent.startup_seconds = 0.25;
       said.find("thinking") == std::string::npos && silent.startup_seconds < 100.0;
       silent.startup_seconds *= 4.0)
    said = message_of([&] { Pool pool(silent); });
  EXPECT_EQ(said, fmt::format(
                      "worker 1 did not report within {:g} s of its start; its log {} ends with:\nthinking\n",
                      silent.startup_seconds / 4.0, log(1)));
}

/// A worker command that fails for the worker whose log has this name.
std::vector<std::string> fails_as(const std::string& log, const std::string& failure) {
  return {
      "/bin/sh", "-c",
      "case $(readlink /proc/$$/fd/1) in *" + log + ") " + failure + ";; esac; exec " FAKE_WORKER " \"$@\"",
      "worker"};
}

TEST_F(PoolTest, AWorkerThatCrashesAtItsStartLeavesTheOthersAtWork) {
  PoolOptions partly = options(3);
  partly.worker_command = fails_as("worker-2.log", "printf 'no room\\n'; kill -SEGV $$");
  std::string told;
  partly.tell = [&](const std::string& text) { told += text + '\n'; };
  Pool pool(partly);
  pool.define(testing::fake_definition(""));
  const std::vector<CellReply> replies = pool.evaluate(random_requests(40));
  for (const CellReply& reply : replies) EXPECT_EQ(reply.response.quality, Quality::good);
  EXPECT_NE(told.find("worker 2 died before it reported: killed by signal 11 (Segmentation fault); its log " +
                      log(2) + " says:\nno room\nthe others go on; it is started again"),
            std::string::npos)
      << told;
  // It is tried again some times, then no more.
  const auto is_given_up = [&] { return told.find("no room\nit is not started again") != std::string::npos; };
  EXPECT_TRUE(testing::eventually(is_given_up, [&] { pool.evaluate(random_requests(40)); })) << told;
}

TEST_F(PoolTest, AWorkerThatNeverReportsLeavesTheOthersAtWork) {
  PoolOptions partly = options(2);
  partly.worker_command = fails_as("worker-1.log", "echo thinking; exec sleep 60");
  std::string told;
  partly.tell = [&](const std::string& text) { told += text + '\n'; };
  // The other one must report in that time: a busy machine needs more of it.
  std::unique_ptr<Pool> pool;
  for (partly.startup_seconds = 0.5; !pool; partly.startup_seconds *= 4.0) {
    try {
      pool = std::make_unique<Pool>(partly);
    } catch (const RunError&) {
      if (partly.startup_seconds > 100.0) throw;
    }
  }
  pool->define(testing::fake_definition(""));
  EXPECT_EQ(pool->evaluate(random_requests(1))[0].response.quality, Quality::good);
  EXPECT_NE(told.find("worker 1 did not report within "), std::string::npos) << told;
  EXPECT_EQ(told.find("worker 2"), std::string::npos) << told;
}

TEST_F(PoolTest, TheSocketsOfAKilledCoordinatorAreRemovedByTheNext) {
  setenv("TMPDIR", directory_.c_str(), 1);
  const auto directories = [this] {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(directory_)) {
      if (entry.path().filename().string().rfind("polargrain-", 0) == 0) names.push_back(entry.path());
    }
    return names;
  };
  const PrivateDirectory living;
  const pid_t killed = fork();
  if (killed == 0) {
    const PrivateDirectory left;
    raise(SIGKILL);
  }
  waitpid(killed, nullptr, 0);
  ASSERT_EQ(directories().size(), 2u);
  {
    const PrivateDirectory next;
    EXPECT_EQ(directories().size(), 2u);
    EXPECT_TRUE(std::filesystem::exists(living.path()));
  }
  EXPECT_EQ(directories(), std::vector<std::string>{living.path()});
  unsetenv("TMPDIR");
}

TEST_F(PoolTest, NothingIsLeftBehind) {
  {
    Pool pool(options(3));
    pool.define(testing::fake_definition(""));
    pool.evaluate(random_requests(3));
  }
  EXPECT_TRUE(testing::children_of(getpid()).empty());
}

}  // namespace
}  // namespace polargrain::coupler
