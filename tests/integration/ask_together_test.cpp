// SPDX-License-Identifier: GPL-2.0-or-later
// Tests side by side over one pool (coupler/points/cell_point.hpp), with simulated workers.
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "coupler/points/cell_point.hpp"
#include "tests/integration/fake_engine.hpp"
#include "tests/integration/pool_fixture.hpp"

namespace polargrain::coupler {
namespace {

using AskTogetherTest = PoolTest;

CellRequest step(const StatePointer& from, std::size_t test) {
  CellRequest request{from, {}};
  request.increment.displacement_gradient(0, 0) = 1e-5 * static_cast<double>(test + 1);
  return request;
}

/// Pointers to states tell the pool when they go: tests and pool must not be at work at the same time.
TEST_F(AskTogetherTest, OneIsAtWorkAtATime) {
  constexpr std::size_t kTests = 6;
  Pool pool(options(2));
  const std::vector<std::uint32_t> definitions(kTests, pool.define(testing::fake_definition("")));
  std::atomic<int> at_work = 0;
  std::atomic<int> most = 0;
  pool.on_progress([&](std::size_t, std::size_t) { most = std::max(most.load(), at_work.load() + 1); });
  std::vector<double> ends(kTests);
  ask_together(pool, definitions, [&](std::size_t test, const AskCell& ask) {
    ++at_work;
    CellReply reply;
    for (std::size_t k = 0; k < 10 + test; ++k) {  // they end one after the other
      --at_work;
      reply = ask(step(reply.state, test));
      most = std::max(most.load(), ++at_work);
      std::this_thread::sleep_for(std::chrono::microseconds(200));  // others that may come, come
    }
    ends[test] = reply.response.stress(0, 0);
    --at_work;
  });
  EXPECT_EQ(most, 1);
  // Linear: E (1 - nu) / ((1 + nu) (1 - 2 nu)) = 120 MPa for the fake engine's 100 MPa and 0.25.
  for (std::size_t test = 0; test < kTests; ++test) {
    const double strain = 1e-5 * static_cast<double>(test + 1) * static_cast<double>(10 + test);
    EXPECT_NEAR(ends[test], -100e3 + 120e6 * strain, 1e-6);
  }
}

TEST_F(AskTogetherTest, AnExceptionOfOneIsThrownOnWhenAllHaveEnded) {
  Pool pool(options(1));
  const std::vector<std::uint32_t> definitions(3, pool.define(testing::fake_definition("")));
  int ended = 0;
  EXPECT_THROW(ask_together(pool, definitions,
                            [&](std::size_t test, const AskCell& ask) {
                              CellReply reply = ask(step(nullptr, test));
                              if (test == 1) throw std::runtime_error("enough");
                              reply = ask(step(reply.state, test));
                              ++ended;
                            }),
               std::runtime_error);
  EXPECT_EQ(ended, 2);
}

TEST_F(AskTogetherTest, TheEndOfThePoolIsTheEndOfAll) {
  Pool pool(options(1));
  pool.on_answers([](auto, auto) { throw RunError("no worker is left"); });
  const std::vector<std::uint32_t> definitions(3, pool.define(testing::fake_definition("")));
  int answered = 0;
  EXPECT_THROW(ask_together(pool, definitions,
                            [&](std::size_t test, const AskCell& ask) {
                              ask(step(nullptr, test));
                              ++answered;
                            }),
               RunError);
  EXPECT_EQ(answered, 0);
}

}  // namespace
}  // namespace polargrain::coupler
