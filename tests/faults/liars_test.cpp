// SPDX-License-Identifier: GPL-2.0-or-later
// Guests with a valid key that say what is false, beside a worker that works: they are found out, named and
// sent away, and the results are those without them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <map>

#include "common/error.hpp"
#include "coupler/pool/pool.hpp"
#include "coupler/pool/process.hpp"
#include "tests/integration/command.hpp"
#include "tests/integration/fake_engine.hpp"
#include "tests/integration/random_requests.hpp"
#include "tests/support/eventually.hpp"

namespace polargrain::coupler {
namespace {

using testing::eventually;
using testing::random_requests;
using testing::Scratch;
using testing::step;

constexpr std::size_t kCells = 30;
constexpr const char* kScript = "sleep_milliseconds 4";

class LiarsTest : public ::testing::TestWithParam<const char*> {
 protected:
  LiarsTest() : scratch_("liars_" + std::string(GetParam())) { make_keys(keys(), "worker"); }

  [[nodiscard]] std::filesystem::path keys() const { return scratch_.path() / "keys"; }
  [[nodiscard]] std::filesystem::path log() const { return scratch_.path() / "guest.log"; }

  [[nodiscard]] PoolOptions options() {
    PoolOptions options;
    options.workers = 1;
    options.directory = scratch_.path();
    options.worker_command = {FAKE_WORKER};
    options.listening = Listening{"tcp://127.0.0.1:*", read_coordinator_keys(keys())};
    options.state_fault = testing::fake_state_fault;
    options.patience.silence_seconds =
        600.0;  // they go for what they say, however long a busy machine takes over it
    options.tell = [this](const std::string& text) { told_ += text + '\n'; };
    return options;
  }
  [[nodiscard]] std::vector<std::string> liar(const std::string& url) const {
    return {STRANGE_WORKER, GetParam(), "--key", (keys() / "worker.key").string(), "--connect", url};
  }

  Scratch scratch_;
  std::string told_;
};

/// The messages to the guest and to the user.
const std::map<std::string, std::string>& causes() {
  static const std::map<std::string, std::string> kCauses{
      {"short", "a state has 100 bytes instead of 48"},
      {"empty", "a state has 0 bytes instead of 48"},
      {"huge", "a state has 20000000 bytes instead of 48"},
      {"nan", "a state holds a number that is not finite"},
      {"lies", "the bytes of a state do not have its name"},
      {"diagnostics", "a cell's diagnostics holds a number that is not finite"},
      {"refuses", "answers the same request: guest 1 on here refuses"},
      {"shouts", "answers the same request: guest 1 on here refuses"},
      {"misses", "it misses something for no reason"},
  };
  return kCauses;
}

TEST_P(LiarsTest, AreSentAwayAndChangeNoByte) {
  Pool pool(options());
  pool.define(testing::fake_definition(kScript));
  Process guest(liar(pool.listening_url()), log());
  std::vector<std::vector<CellReply>> steps{{}};
  // Steps until it has been found out, and one more.
  const auto take_a_step = [&] { steps.push_back(step(pool, kCells, steps.back())); };
  eventually([&] { return guest.end().has_value(); }, take_a_step);
  take_a_step();
  ASSERT_EQ(guest.end().value_or("still there"), "exit status 1") << told_;

  const std::string& cause = causes().at(GetParam());
  EXPECT_NE(testing::content(log()).find(cause), std::string::npos) << testing::content(log());
  EXPECT_NE(told_.find("guest 1 on here was given up"), std::string::npos) << told_;
  EXPECT_NE(told_.find(cause), std::string::npos) << told_;
  EXPECT_EQ(pool.counts().workers_lost, 1) << told_;
  // Words from outside are cut, and steer no terminal.
  EXPECT_LT(told_.size(), 10000u);
  for (const char c : told_) ASSERT_TRUE(c == '\n' || (c >= 0x20 && c != 0x7f)) << static_cast<int>(c);

  PoolOptions alone = options();
  alone.listening.reset();
  Pool undisturbed(alone);
  undisturbed.define(testing::fake_definition(""));
  std::vector<CellReply> expected;
  for (std::size_t s = 1; s < steps.size(); ++s) {
    expected = step(undisturbed, kCells, expected);
    for (std::size_t r = 0; r < kCells; ++r) {
      ASSERT_EQ(steps[s][r].response.quality, Quality::good) << steps[s][r].response.message;
      EXPECT_EQ(steps[s][r].response.stress, expected[r].response.stress);
      EXPECT_EQ(steps[s][r].state->name(), expected[r].state->name());
    }
  }
}

class FalseNamesTest : public LiarsTest {
 protected:
  /// Steps until the guest has gone with what it named. @returns the replies of the last
  std::vector<CellReply> until_it_is_gone(Pool& pool, Process& guest) {
    std::vector<CellReply> replies;
    eventually([&] { return guest.end().has_value(); }, [&] { replies = step(pool, kCells, {}); });
    return replies;
  }
};

TEST_P(FalseNamesTest, TrueNumbersAreUsedAndFalseOnesEndTheRun) {
  Pool pool(options());
  pool.define(testing::fake_definition(kScript));
  Process guest(liar(pool.listening_url()), log());
  if (GetParam() == std::string("falsifies")) {
    try {
      until_it_is_gone(pool, guest);
      FAIL() << told_;
    } catch (const RunError& error) {
      EXPECT_NE(std::string(error.what())
                    .find("comes to another state, and to other numbers than guest 1 on here gave, which are "
                          "in the results of this step: guest 1 on here has sent a false answer"),
                std::string::npos)
          << error.what();
    }
    return;
  }
  const std::vector<CellReply> replies = until_it_is_gone(pool, guest);
  ASSERT_TRUE(guest.end());
  EXPECT_NE(told_.find("guest 1 on here named a false state; its numbers were right"), std::string::npos)
      << told_;
  PoolOptions alone = options();
  alone.listening.reset();
  Pool undisturbed(alone);
  undisturbed.define(testing::fake_definition(""));
  const std::vector<CellReply> expected = step(undisturbed, kCells, {});
  for (std::size_t r = 0; r < kCells; ++r) {
    EXPECT_EQ(replies[r].response.stress, expected[r].response.stress);
    EXPECT_EQ(replies[r].state->name(), expected[r].state->name());
    EXPECT_TRUE(replies[r].state->is_here());
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, FalseNamesTest, ::testing::Values("misnames", "falsifies"),
                         [](const auto& each) { return std::string(each.param); });

INSTANTIATE_TEST_SUITE_P(Ways, LiarsTest,
                         ::testing::Values("short", "empty", "huge", "nan", "lies", "diagnostics", "refuses",
                                           "shouts", "misses"),
                         [](const auto& each) { return std::string(each.param); });

}  // namespace
}  // namespace polargrain::coupler
