// SPDX-License-Identifier: GPL-2.0-or-later
// A worker that others keep from the processors is not taken for hung; one that is stopped, or loops without end, is.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>

#include "coupler/pool/process.hpp"
#include "tests/support/eventually.hpp"

namespace polargrain::coupler {
namespace {

using namespace std::chrono_literals;

TEST(ProcessorShare, TimeInWhichOthersRanIsExcused) {
  EXPECT_EQ(starved_between({5ms, 10ms, true}, {6ms, 30ms, true}, 25ms), 20ms);
  // A wait that is not over is not among those told of.
  EXPECT_EQ(starved_between({5ms, 10ms, true}, {5ms, 10ms, true}, 25ms), 25ms);
  // Its end must not excuse more than there was.
  EXPECT_EQ(starved_between({5ms, 10ms, true}, {6ms, 5s, true}, 25ms), 25ms);
}

TEST(ProcessorShare, NothingElseIsExcused) {
  EXPECT_EQ(starved_between({5ms, 10ms, true}, {30ms, 10ms, true}, 25ms), 0ms);  // it loops
  EXPECT_EQ(starved_between({5ms, 10ms, true}, {5ms, 10ms, false}, 25ms), 0ms);  // it sleeps, or is stopped
  EXPECT_EQ(starved_between({5ms, 10ms, true}, {0ms, 0ms, false}, 25ms), 0ms);   // it is gone
  EXPECT_EQ(starved_between({}, {}, 25ms), 0ms);                                 // the system does not tell
}

TEST(ProcessorShare, AStoppedProcessIsNotReady) {
  if (!std::filesystem::exists("/proc/self/schedstat")) GTEST_SKIP() << "this system does not tell";
  Process loop({"/bin/sh", "-c", "while :; do :; done"}, "/dev/null");
  const auto runs = [&] { return loop.processor_share().ready && loop.processor_share().ran > 1ms; };
  EXPECT_TRUE(testing::eventually(runs));
  kill(loop.id(), SIGSTOP);
  EXPECT_TRUE(testing::eventually([&] { return loop.stopped(); }));
  const ProcessorShare before = loop.processor_share();
  usleep(20000);
  EXPECT_EQ(starved_between(before, loop.processor_share(), 20ms), 0ms);
}

}  // namespace
}  // namespace polargrain::coupler
