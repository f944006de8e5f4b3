// SPDX-License-Identifier: GPL-2.0-or-later
// Cells know nothing of each other: two that live in one process answer what each answers alone, bit for bit.
#include <gtest/gtest.h>

#include <cstring>
#include <thread>
#include <vector>

#include "common/error.hpp"
#include "tests/support/cell_fixture.hpp"
#include "tests/support/plane_cells.hpp"

namespace polargrain::dem {
namespace {

bool same_bits(const CellReply& a, const CellReply& b) {
  return std::memcmp(a.response.stress.data(), b.response.stress.data(), sizeof a.response.stress) == 0 &&
         std::memcmp(a.response.couple_stress.data(), b.response.couple_stress.data(),
                     sizeof a.response.couple_stress) == 0 &&
         std::memcmp(a.response.tangent.data(), b.response.tangent.data(), sizeof a.response.tangent) == 0 &&
         a.state->name() == b.state->name();
}

/// A cell and the way it is led.
struct Way {
  CellDefinition definition;
  CellIncrement increment;

  /// Goes on from the last of the answers by the increment.
  void go_on(CellOfGrains& cell, std::vector<CellReply>& replies) const {
    replies.push_back(cell.evaluate({replies.empty() ? nullptr : replies.back().state, increment}));
  }
};

constexpr int kSteps = 3;

/// Mean rotation and curvature prescribed: the curvature rate is what such a cell tells its contacts.
Way bent(CellLoop loop) {
  Way way{test::rolling_cell(1.0, 0.4), {}};
  way.definition.control.rotations = CellRotations::controlled;
  way.definition.control.loop = loop;
  way.increment.displacement_gradient(0, 1) = 2e-4;
  way.increment.rotation(2) = 1e-4;
  way.increment.curvature(2, 0) = 0.02;
  return way;
}

Way compressed(CellLoop loop) {
  Way way{test::demo_cell(), {}};
  way.definition.control.loop = loop;
  way.increment.displacement_gradient(1, 1) = -3e-4;
  return way;
}

std::vector<CellReply> alone(const Way& way) {
  const auto cell = make_cell_service(way.definition);
  std::vector<CellReply> replies;
  for (int step = 0; step < kSteps; ++step) way.go_on(*cell, replies);
  return replies;
}

class TwoCells : public ::testing::TestWithParam<CellLoop> {};

TEST_P(TwoCells, InTurnsAnswerAsEachAlone) {
  const Way one = bent(GetParam());
  const Way other = compressed(GetParam());
  const std::vector<CellReply> one_alone = alone(one);
  const std::vector<CellReply> other_alone = alone(other);
  const auto first = make_cell_service(one.definition);
  const auto second = make_cell_service(other.definition);
  std::vector<CellReply> one_in_turns;
  std::vector<CellReply> other_in_turns;
  for (int step = 0; step < kSteps; ++step) {
    one.go_on(*first, one_in_turns);
    const std::vector<Contact> contacts(first->contacts().begin(), first->contacts().end());
    other.go_on(*second, other_in_turns);
    // The record of the first is still its own.
    ASSERT_EQ(contacts.size(), first->contacts().size());
    for (std::size_t c = 0; c < contacts.size(); ++c)
      ASSERT_EQ(contacts[c].force, first->contacts()[c].force) << c;
  }
  for (int step = 0; step < kSteps; ++step) {
    EXPECT_TRUE(same_bits(one_in_turns[step], one_alone[step])) << step;
    EXPECT_TRUE(same_bits(other_in_turns[step], other_alone[step])) << step;
  }
}

INSTANTIATE_TEST_SUITE_P(Loops, TwoCells, ::testing::Values(CellLoop::automatic, CellLoop::engine),
                         [](const auto& each) {
                           return each.param == CellLoop::engine ? "OfTheEngine" : "OverDiscs";
                         });

/// The engine's own loop speaks through MPI, which this process starts for one thread; the loop over discs does not.
TEST(TwoCellsInThreads, AnswerAsEachAlone) {
  const Way ways[] = {bent(CellLoop::automatic), compressed(CellLoop::automatic)};
  std::vector<CellReply> replies[2];
  {
    const std::unique_ptr<CellOfGrains> cells[] = {make_cell_service(ways[0].definition),
                                                   make_cell_service(ways[1].definition)};
    std::vector<std::thread> threads;
    for (int k = 0; k < 2; ++k)
      threads.emplace_back([&, k] {
        for (int step = 0; step < kSteps; ++step) ways[k].go_on(*cells[k], replies[k]);
      });
    for (std::thread& thread : threads) thread.join();
  }
  for (int k = 0; k < 2; ++k) {
    const std::vector<CellReply> expected = alone(ways[k]);
    for (int step = 0; step < kSteps; ++step) EXPECT_TRUE(same_bits(replies[k][step], expected[step])) << k;
  }
}

/// Discs have a plane; what a cell is asked and cannot do, it says.
TEST(CellOfDiscs, RefusesToLeaveItsPlane) {
  const auto cell = make_cell_service(test::demo_cell());
  const auto refusal = [&cell](const auto& change) {
    CellRequest request;
    change(request.increment);
    try {
      cell->evaluate(request);
    } catch (const RunError& error) {
      return std::string(error.what());
    }
    return std::string("it went along");
  };
  for (const auto& [i, j] : {std::pair(2, 2), std::pair(0, 2), std::pair(2, 1)})
    EXPECT_NE(refusal([i, j](CellIncrement& h) {
                h.displacement_gradient(i, j) = 1e-4;
              }).find("discs cannot move out of their plane"),
              std::string::npos);
  EXPECT_NE(refusal([](CellIncrement& h) { h.rotation(0) = 1e-4; }).find("about the normal of their plane"),
            std::string::npos);
  EXPECT_NE(
      refusal([](CellIncrement& h) { h.curvature(0, 1) = 1e-4; }).find("about the normal of their plane"),
      std::string::npos);
  EXPECT_EQ(refusal([](CellIncrement& h) { h.displacement_gradient(0, 0) = -1e-5; }), "it went along");
  EXPECT_EQ(cell->initial().response.known, KnownComponents::plane);
}

}  // namespace
}  // namespace polargrain::dem
