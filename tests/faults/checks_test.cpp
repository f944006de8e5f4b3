// SPDX-License-Identifier: GPL-2.0-or-later
// workers: {check: SHARE}: one worker whose last digits are false, beside others that compute as they should.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>

#include "common/error.hpp"
#include "coupler/pool/pool.hpp"
#include "coupler/pool/process.hpp"
#include "tests/faults/fake_case.hpp"
#include "tests/integration/fake_engine.hpp"
#include "tests/integration/random_requests.hpp"
#include "tests/support/eventually.hpp"

namespace polargrain::coupler {
namespace {

using testing::eventually;
using testing::random_requests;
using testing::Scratch;
using testing::step;

constexpr std::size_t kCells = 60;
constexpr const char* kScript = "sleep_milliseconds 4";

class ChecksTest : public ::testing::Test {
 protected:
  ChecksTest() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    make_keys(scratch_.path() / "keys", "worker");
  }
  ~ChecksTest() override { unsetenv("FAKE_ENGINE_FORGES"); }

  [[nodiscard]] PoolOptions options(int workers, double share) {
    PoolOptions options;
    options.workers = workers;
    options.directory = scratch_.path();
    options.worker_command = {FAKE_WORKER};
    options.check_share = share;
    options.listening = Listening{"tcp://127.0.0.1:*", read_coordinator_keys(scratch_.path() / "keys")};
    options.tell = [this](const std::string& text) { told_ += text + '\n'; };
    return options;
  }
  /// The first local worker that takes up a cell forges, and no process that comes after it.
  void let_one_forge() const { setenv("FAKE_ENGINE_FORGES", (scratch_.path() / "forger").c_str(), 1); }
  [[nodiscard]] std::vector<std::string> guest(const std::string& url, bool forges,
                                               const std::string& key = "worker.key") const {
    return {"/usr/bin/env",
            forges ? "FAKE_ENGINE_FORGES=1" : "-uFAKE_ENGINE_FORGES",
            FAKE_WORKER,
            "--key",
            (scratch_.path() / "keys" / key).string(),
            "--connect",
            url};
  }

  Scratch scratch_;
  std::string told_;
};

/// Whether these are the answers of the closed form, to the bit.
bool are_true(const std::vector<CellReply>& replies) {
  const std::vector<PoolRequest> requests = random_requests(replies.size());
  for (std::size_t r = 0; r < replies.size(); ++r)
    if (replies[r].response.stress != testing::fake_stress(requests[r].cell.increment)) return false;
  return true;
}

/// Steps until somebody has been found out, with answers that are true.
template <class Found>
void step_until(Pool& pool, Found found) {
  EXPECT_TRUE(eventually(found, [&] { EXPECT_TRUE(are_true(step(pool, kCells, {}))); }));
}

TEST_F(ChecksTest, OneForgerOfThreeIsFoundAndItsAnswersAreMadeAgain) {
  let_one_forge();
  Pool pool(options(3, 1.0));
  pool.define(testing::fake_definition(kScript));
  const std::vector<CellReply> first = step(pool, kCells, {});
  EXPECT_TRUE(are_true(first));
  const std::vector<CellReply> second = step(pool, kCells, first);
  for (const CellReply& reply : second) EXPECT_TRUE(reply.state->is_here());
  EXPECT_EQ(pool.counts().workers_lost, 1) << told_;
  EXPECT_EQ(pool.counts().evaluations_checked, 2 * static_cast<int>(kCells)) << told_;
  EXPECT_NE(told_.find("who agree to the bit: it has sent a false answer"), std::string::npos) << told_;
}

// Never a false answer without a word: either it was found before anything of it was returned, or the run ends.
TEST_F(ChecksTest, ASampleFindsTheForgerOrNothingFalseIsReturnedInSilence) {
  int ended = 0;
  int mended = 0;
  for (const double share : {0.1, 0.5}) {
    std::filesystem::remove_all(scratch_.path() / "forger");
    let_one_forge();
    told_.clear();
    Pool pool(options(3, share));
    pool.define(testing::fake_definition(kScript));
    bool was_false = false;
    try {
      const auto is_known = [&] { return pool.counts().workers_lost > 0; };
      EXPECT_TRUE(eventually(is_known, [&] { was_false |= !are_true(step(pool, kCells, {})); })) << told_;
      EXPECT_FALSE(was_false) << share << '\n' << told_;
      EXPECT_TRUE(are_true(step(pool, kCells, {}))) << share;
      ++mended;
    } catch (const FalseResults& error) {
      EXPECT_NE(std::string(error.what()).find("that nobody has checked were used before"), std::string::npos)
          << error.what();
      ++ended;
    }
  }
  std::cout << "[figure] a forger was found before its answers were used " << mended << " times, later "
            << ended << " times\n";
}

// By the time that an evaluation is drawn, answers of the forger have been returned.
TEST_F(ChecksTest, FalseAnswersThatWereUsedEndTheRun) {
  let_one_forge();
  Pool pool(options(3, 0.002));
  pool.define(testing::fake_definition("sleep_milliseconds 1"));
  int steps = 0;
  try {
    eventually([] { return false; }, [&] { step(pool, kCells, {}), ++steps; });
    FAIL() << told_;
  } catch (const FalseResults& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find("of its answers that nobody has checked were used before"), std::string::npos)
        << words;
  }
  EXPECT_GT(steps, 0);
}

TEST_F(ChecksTest, TwoThatDisagreeEndTheRun) {
  let_one_forge();
  Pool pool(options(2, 1.0));
  pool.define(testing::fake_definition(kScript));
  try {
    step(pool, kCells, {});
    // A forger that is stopped is replaced by an honest one: that would be the third.
    FAIL() << told_;
  } catch (const FalseResults& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find("worker 1"), std::string::npos) << words;
    EXPECT_NE(words.find("worker 2"), std::string::npos) << words;
    EXPECT_NE(words.find("there is no third worker"), std::string::npos) << words;
  }
}

TEST_F(ChecksTest, AGuestIsCheckedByAProcessOfOurOwn) {
  Pool pool(options(1, 1.0));
  pool.define(testing::fake_definition(kScript));
  Process liar(guest(pool.listening_url(), true), scratch_.path() / "guest.log");
  Process honest(guest(pool.listening_url(), false), scratch_.path() / "honest.log");
  step_until(pool, [&] { return liar.end().has_value(); });
  EXPECT_EQ(liar.end().value_or("still there"), "exit status 1") << told_;
  EXPECT_NE(testing::content(scratch_.path() / "guest.log").find("it has sent a false answer"),
            std::string::npos)
      << testing::content(scratch_.path() / "guest.log");
  EXPECT_FALSE(honest.end());
}

// Two guests with keys of their own who say the same are not more than one of ours.
TEST_F(ChecksTest, GuestsThatAgreeOnWhatIsFalseDoNotOutvoteOneOfOurOwn) {
  make_keys(scratch_.path() / "keys", "second");
  for (const int ours : {1, 2}) {
    told_.clear();
    Pool pool(options(ours, 1.0));
    pool.define(testing::fake_definition(kScript));
    Process one(guest(pool.listening_url(), true), scratch_.path() / "guest.log");
    Process two(guest(pool.listening_url(), true, "second.key"), scratch_.path() / "guest.log");
    step_until(pool, [&] { return one.end().has_value() && two.end().has_value(); });
    EXPECT_EQ(pool.counts().workers_lost, 2) << told_;
  }
}

// Without a third one ours counts.
TEST_F(ChecksTest, AGuestAgainstOneOfOurOwnIsNotBelieved) {
  Pool pool(options(1, 1.0));
  pool.define(testing::fake_definition(kScript));
  Process liar(guest(pool.listening_url(), true), scratch_.path() / "guest.log");
  step_until(pool, [&] { return liar.end().has_value(); });
  EXPECT_EQ(liar.end().value_or("still there"), "exit status 1") << told_;
  EXPECT_NE(told_.find("otherwise than worker 1, a process of this machine"), std::string::npos) << told_;
}

TEST_F(ChecksTest, OneWorkerChecksNothing) {
  PoolOptions alone = options(1, 1.0);
  alone.listening.reset();
  Pool pool(alone);
  pool.define(testing::fake_definition(""));
  EXPECT_TRUE(are_true(step(pool, kCells, {})));
  EXPECT_EQ(pool.counts().evaluations_checked, 0);
  EXPECT_EQ(pool.counts().evaluations, static_cast<int>(kCells));
}

// A cell that fails, and one that no engine survives, are what they are without checks.
TEST_F(ChecksTest, CellsThatFailDoSoForAll) {
  for (const char* script : {"fail_beyond 1e-9", "die_beyond 1e-9", "refuse_beyond 1e-9"}) {
    Pool pool(options(2, 1.0));
    pool.define(testing::fake_definition(script));
    for (const CellReply& reply : pool.evaluate(random_requests(2)))
      EXPECT_EQ(reply.response.quality, Quality::failed) << script;
  }
}

/// Whole runs. Trusted scripts: who is to forge is told by a directory that a worker makes outside of its own.
class CheckedRunsTest : public testing::FakeCaseTest {};

TEST_F(CheckedRunsTest, TheShareAndTheWorkersChangeNoByte) {
  const std::string command = this->command(6, " --set workers.check=");
  std::string expected;
  for (const auto& [share, workers] :
       {std::pair("0", 1), {"0", 3}, {"100 %", 1}, {"1 %", 2}, {"30 %", 3}, {"100 %", 2}, {"100 %", 3}}) {
    const testing::Outcome outcome =
        testing::run_in(scratch_.path(), command + "'" + share + "' -o out -w " + std::to_string(workers));
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
    const std::string history = result("out/history.csv");
    if (expected.empty()) expected = history;
    EXPECT_EQ(history, expected) << share << ' ' << workers;
    const bool checks = workers > 1 && share != std::string("0");
    const std::string none = "\"evaluations_checked\": 0,";
    EXPECT_EQ(result("out/summary.json").find(none) == std::string::npos, checks) << share << ' ' << workers;
    const bool can_none = workers == 1 && share != std::string("0");
    EXPECT_EQ(result("out/run.log").find("with one worker no evaluation can be checked") != std::string::npos,
              can_none);
  }
}

TEST_F(CheckedRunsTest, AForgerIsSentAwayAndTheHistoryIsThatOfAnHonestRun) {
  const std::string disturbed = prepare(5);
  const testing::Outcome outcome = testing::run_in(
      scratch_.path(), "FAKE_ENGINE_FORGES=$PWD/forger " +
                           command(5, " --set workers.check=1 --trust-scripts -o disturbed -w 3"));
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_EQ(result("disturbed/history.csv"), result("quiet/history.csv"));
  EXPECT_NE(result("disturbed/run.log").find("who agree to the bit"), std::string::npos);
}

// Found late: nothing is left that could be gone on from by mistake.
TEST_F(CheckedRunsTest, AForgerThatIsFoundLateLeavesNoCheckpointToGoOnFrom) {
  const testing::Outcome outcome = testing::run_in(
      scratch_.path(),
      "FAKE_ENGINE_FORGES=$PWD/forger " +
          command(100, " --set workers.check=0.002 --trust-scripts --checkpoint-minutes 0 -o out -w 3"));
  EXPECT_EQ(outcome.status, 1) << outcome.errors;
  EXPECT_NE(outcome.errors.find("files of this run may be false"), std::string::npos) << outcome.errors;
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "out" / "checkpoint.h5"));
  EXPECT_TRUE(std::filesystem::exists(scratch_.path() / "out" / "checkpoint.doubtful.h5"));
  EXPECT_EQ(outcome.errors.find("to go on:"), std::string::npos) << outcome.errors;
}

TEST_F(CheckedRunsTest, CheckSaysWhatTheShareMeansAndRefusesMoreThanAll) {
  const std::string check = FAKE_POLARGRAIN " check case.yaml --set workers.check=";
  const testing::Outcome good = testing::run_in(scratch_.path(), check + "'1 %'");
  EXPECT_EQ(good.status, 0);
  EXPECT_NE(
      good.out.find("1 % of the evaluations are made by two workers; one worker alone checks no evaluation"),
      std::string::npos)
      << good.out;
  const testing::Outcome bad = testing::run_in(scratch_.path(), check + "1.5");
  EXPECT_EQ(bad.status, 2);
  EXPECT_NE(bad.errors.find("check: must be at most 1, found"), std::string::npos) << bad.errors;
}

}  // namespace
}  // namespace polargrain::coupler
