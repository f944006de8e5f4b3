// SPDX-License-Identifier: GPL-2.0-or-later
// Bad lines and workers that talk nonsense.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <iostream>

#include "common/error.hpp"
#include "coupler/pool/pool.hpp"
#include "tests/integration/command.hpp"
#include "tests/integration/fake_engine.hpp"
#include "tests/integration/random_requests.hpp"

namespace polargrain::coupler {
namespace {

using testing::random_requests;

using testing::Scratch;

class MessageFaultsTest : public ::testing::Test {
 protected:
  MessageFaultsTest() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {}

  /// @param silence_seconds what is lost on the line is asked for again in a tenth of it
  [[nodiscard]] PoolOptions options(int workers, const std::vector<std::string>& command,
                                    double silence_seconds = 30.0) {
    PoolOptions options;
    options.workers = workers;
    options.directory = scratch_.path();
    options.worker_command = command;
    options.patience.silence_seconds = silence_seconds;
    options.tell = [this](const std::string& text) { told_ += text + '\n'; };
    return options;
  }

  Scratch scratch_;
  std::string told_;
};

/// Ten batches, each from the states of the one before.
std::vector<CellReply> chain(Pool& pool, std::size_t cells) {
  pool.define(testing::fake_definition(""));
  std::vector<CellReply> replies;
  for (int batch = 0; batch < 10; ++batch) {
    replies = pool.evaluate(random_requests(cells, replies));
    std::vector<StatePointer> states;
    for (const CellReply& reply : replies) {
      EXPECT_EQ(reply.response.quality, Quality::good);
      states.push_back(reply.state);
    }
    states = pool.collect(states);
    for (std::size_t r = 0; r < cells; ++r) replies[r].state = states[r];
  }
  return replies;
}

TEST_F(MessageFaultsTest, LostDoubledDelayedAndCutMessagesChangeNothing) {
  Pool undisturbed(options(1, {FAKE_WORKER}));
  const std::vector<CellReply> expected = chain(undisturbed, 20);
  Pool pool(options(4, {FAULTY_LINE, "11", "4", FAKE_WORKER}, 4.0));
  const std::vector<CellReply> replies = chain(pool, 20);
  for (std::size_t r = 0; r < replies.size(); ++r) {
    EXPECT_EQ(replies[r].response.quality, Quality::good);
    EXPECT_EQ(std::memcmp(replies[r].response.stress.data(), expected[r].response.stress.data(),
                          sizeof(Eigen::Matrix3d)),
              0);
    EXPECT_EQ(replies[r].state->name(), expected[r].state->name());
  }
  std::cout << "[figure] 200 evaluations over lines that spoil 16 % of all messages; workers given up: "
            << pool.counts().workers_lost << '\n';
}

TEST_F(MessageFaultsTest, AWorkerOfAnotherVersionIsRefusedAtTheStart) {
  try {
    const Pool pool(options(1, {STRANGE_WORKER, "version"}));
    FAIL() << "accepted";
  } catch (const RunError& error) {
    EXPECT_EQ(std::string(error.what()).find("a worker cannot be used: it speaks version"), 0u)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("use the same polargrain on both sides"), std::string::npos);
  }
}

TEST_F(MessageFaultsTest, AWorkerThatSendsGarbageIsGivenUp) {
  Pool pool(options(1, {STRANGE_WORKER, "garbage"}));
  pool.define(testing::fake_definition(""));
  const std::vector<CellReply> replies = pool.evaluate(random_requests(1));
  EXPECT_EQ(replies[0].response.quality, Quality::failed);
  EXPECT_NE(replies[0].response.message.find(
                "was given up at work on point 0 of material 'sand' (fake.in): it sent "
                "an unusable message"),
            std::string::npos)
      << replies[0].response.message;
}

/// Evaluates some cells and collects their states.
void expect_states_of_strange_worker(Pool& pool) {
  pool.define(testing::fake_definition(""));
  std::vector<StatePointer> states;
  for (const CellReply& reply : pool.evaluate(random_requests(8))) states.push_back(reply.state);
  const std::vector<StatePointer> here = pool.collect(states);
  for (std::size_t s = 0; s < states.size(); ++s) {
    ASSERT_TRUE(here[s]->is_here());
    EXPECT_EQ(name_of(here[s]->bytes()), states[s]->name());
  }
  EXPECT_EQ(pool.counts().evaluations_again, 8);
}

TEST_F(MessageFaultsTest, StatesThatAWorkerHasDroppedAreMadeAgain) {
  Pool pool(options(1, {STRANGE_WORKER, "forgets"}));
  expect_states_of_strange_worker(pool);
  EXPECT_EQ(pool.counts().workers_lost, 0);
}

TEST_F(MessageFaultsTest, AWorkerThatSendsOtherStatesIsGivenUp) {
  Pool pool(options(1, {STRANGE_WORKER, "lies"}));
  expect_states_of_strange_worker(pool);
  EXPECT_EQ(pool.counts().workers_lost, 1);
  EXPECT_NE(told_.find("the bytes of a state do not have its name"), std::string::npos) << told_;
}

TEST_F(MessageFaultsTest, AWorkerThatNeverAnswersIsGivenUp) {
  Pool pool(options(1, {STRANGE_WORKER, "nothing"}, 0.5));
  pool.define(testing::fake_definition(""));
  const std::vector<CellReply> replies = pool.evaluate(random_requests(1));
  EXPECT_EQ(replies[0].response.quality, Quality::failed);
  EXPECT_NE(replies[0].response.message.find("it hangs"), std::string::npos) << replies[0].response.message;
}

}  // namespace
}  // namespace polargrain::coupler
