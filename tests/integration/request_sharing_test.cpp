// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/request_sharing.hpp"

#include <gtest/gtest.h>

#include "coupler/pool/pool.hpp"
#include "tests/integration/command.hpp"
#include "tests/integration/fake_engine.hpp"

namespace polargrain::coupler {
namespace {

PoolRequest request_of(double amount, StatePointer state = nullptr) {
  PoolRequest request;
  request.cell.state = std::move(state);
  request.cell.increment.displacement_gradient(0, 0) = amount;
  return request;
}

TEST(RequestSharing, AlikeMeansTheSameBitsOfEverything) {
  const auto bytes = [](char c) { return std::vector<std::byte>(8, static_cast<std::byte>(c)); };
  const auto one = std::make_shared<const State>(bytes('a'));
  const auto equal = std::make_shared<const State>(bytes('a'));
  const auto other = std::make_shared<const State>(bytes('b'));
  PoolRequest turned = request_of(1e-3);
  turned.cell.increment.rotation(2) = 1e-9;
  PoolRequest of_another_cell = request_of(1e-3);
  of_another_cell.definition = 1;
  const std::vector<PoolRequest> requests{
      request_of(1e-3), request_of(1e-3, one), request_of(1e-3, equal), request_of(1e-3, other),
      request_of(1e-3), request_of(-0.0),      request_of(0.0),         turned,
      of_another_cell};
  EXPECT_EQ(first_alike(requests), (std::vector<std::size_t>{0, 1, 1, 3, 0, 5, 6, 7, 8}));
}

TEST(RequestSharing, APoolEvaluatesEqualRequestsOnce) {
  testing::Scratch scratch("RequestSharing");
  PoolOptions options;
  options.workers = 2;
  options.directory = scratch.path();
  options.worker_command = {FAKE_WORKER};
  Pool pool(options);
  pool.define(testing::fake_definition(""));
  std::vector<PoolRequest> requests;
  for (int r = 0; r < 30; ++r) requests.push_back(request_of(1e-4 * (1 + r % 3)));
  const std::vector<CellReply> replies = pool.evaluate(requests);
  EXPECT_EQ(pool.counts().evaluations, 3);
  ASSERT_EQ(replies.size(), 30u);
  for (int r = 0; r < 30; ++r) {
    EXPECT_EQ(replies[r].response.stress, pool.evaluate({&requests[r], 1}).front().response.stress);
    ASSERT_NE(replies[r].state, nullptr);
  }
}

}  // namespace
}  // namespace polargrain::coupler
