// SPDX-License-Identifier: GPL-2.0-or-later
// A cell is a value: what it answers depends on its state and its increment alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

#include "common/error.hpp"
#include "tests/support/cell_fixture.hpp"
#include "tests/support/plane_cells.hpp"

namespace polargrain::dem {
namespace {

PlaneRequest request(StatePointer state, double h11, double h12, double h21, double h22) {
  PlaneRequest made;
  made.state = std::move(state);
  made.increment.displacement_gradient << h11, h12, h21, h22;
  return made;
}

bool same_bits(const PlaneReply& a, const PlaneReply& b) {
  return std::memcmp(a.response.stress.data(), b.response.stress.data(), sizeof(Vector7)) == 0 &&
         std::memcmp(a.response.tangent.data(), b.response.tangent.data(), sizeof(Matrix7)) == 0 &&
         a.state->name() == b.state->name() && std::ranges::equal(a.state->bytes(), b.state->bytes());
}

TEST(Cell, SameRequestGivesTheSameBitsWhateverCameBetween) {
  const auto cell = make_plane_cell(test::demo_cell());
  const PlaneRequest first = request(nullptr, 5e-4, 2e-4, 0.0, -5e-4);
  const PlaneReply once = cell->evaluate(first);
  cell->evaluate(request(once.state, -2e-3, 0.0, 1e-3, 1e-3));
  const PlaneReply twice = cell->evaluate(first);
  EXPECT_TRUE(same_bits(once, twice));

  // Another engine, and a state that went through bytes.
  const auto other = make_plane_cell(test::demo_cell());
  const auto copy = std::make_shared<const State>(
      std::vector<std::byte>(once.state->bytes().begin(), once.state->bytes().end()));
  const PlaneRequest second = request(once.state, 3e-4, 0.0, 1e-4, -6e-4);
  const PlaneReply here = cell->evaluate(second);
  const PlaneReply there = other->evaluate(request(copy, 3e-4, 0.0, 1e-4, -6e-4));
  EXPECT_TRUE(same_bits(here, there));
  EXPECT_FALSE(same_bits(here, once));
  std::printf("[figure] state of 400 grains: %zu bytes, %.0f a grain\n", once.state->bytes().size(),
              static_cast<double>(once.state->bytes().size()) / 400.0);
}

TEST(Cell, SameBitsWithPrescribedRotationsToo) {
  CellDefinition definition = test::demo_cell();
  definition.control.rotations = CellRotations::controlled;
  const auto cell = make_plane_cell(definition);
  PlaneRequest first = request(nullptr, 5e-4, 2e-4, 0.0, -5e-4);
  first.increment.micro_rotation = 1e-3;
  const PlaneReply once = cell->evaluate(first);
  cell->evaluate(request(once.state, -2e-3, 0.0, 1e-3, 1e-3));  // leaves other forces behind
  EXPECT_TRUE(same_bits(once, cell->evaluate(first)));
}

TEST(Cell, ZeroIncrementHoldsTheStress) {
  const auto cell = make_plane_cell(test::demo_cell());
  const PlaneReply loaded = cell->evaluate(request(nullptr, 1e-4, 0.0, 0.0, -1e-4));
  const PlaneReply held = cell->evaluate(request(loaded.state, 0.0, 0.0, 0.0, 0.0));
  // The unbalanced rest (half a percent of a contact force) may still creep.
  EXPECT_LT((held.response.stress - loaded.response.stress).norm(), 5e-3 * loaded.response.stress.norm());
}

TEST(Cell, RigidRotationTurnsTheStress) {
  const auto cell = make_plane_cell(test::demo_cell());
  const PlaneReply sheared = cell->evaluate(request(nullptr, 3e-4, 0.0, 0.0, -3e-4));
  const double angle = 0.2;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const PlaneReply turned = cell->evaluate(request(sheared.state, c - 1.0, -s, s, c - 1.0));
  Eigen::Matrix2d before;
  before << sheared.response.stress(k11), sheared.response.stress(k12), sheared.response.stress(k21),
      sheared.response.stress(k22);
  Eigen::Matrix2d turn;
  turn << c, -s, s, c;
  const Eigen::Matrix2d expected = turn * before * turn.transpose();
  Eigen::Matrix2d after;
  after << turned.response.stress(k11), turned.response.stress(k12), turned.response.stress(k21),
      turned.response.stress(k22);
  std::printf("[figure] stress after a rigid rotation of 0.2 rad differs by %.2e of its norm\n",
              (after - expected).norm() / before.norm());
  // The box turns and does nothing else; what was left unbalanced (half a percent) creeps on.
  EXPECT_LT((after - expected).norm(), 2e-3 * before.norm());
}

TEST(Cell, TiltedBoxGoesOnSmoothlyAfterAFlip) {
  const auto cell = make_plane_cell(test::demo_cell());
  StatePointer state;
  double previous = 0.0;
  double largest_jump = 0.0;
  // Simple shear to 0.6 in steps of 0.02: the box flips at 0.5.
  for (int step = 1; step <= 30; ++step) {
    const PlaneReply reply = cell->evaluate(request(state, 0.0, 0.02, 0.0, 0.0));
    ASSERT_NE(reply.state, nullptr);
    state = reply.state;
    const double ratio = reply.response.stress(k21) / reply.response.stress(k22);
    if (step > 10) largest_jump = std::max(largest_jump, std::abs(ratio - previous));
    previous = ratio;
    ASSERT_TRUE(std::isfinite(ratio));
  }
  std::printf("[figure] simple shear to 60 %%: largest change of the stress ratio in a step %.3f\n",
              largest_jump);
  // Steps before the flip scatter by as much: 400 grains under steady flow.
  EXPECT_LT(largest_jump, 0.15);
}

TEST(Cell, RefusesForeignStatesAndAbsurdIncrements) {
  const auto cell = make_plane_cell(test::demo_cell());
  const auto garbage = std::make_shared<const State>(std::vector<std::byte>(1000, std::byte{7}));
  EXPECT_THROW(cell->evaluate(request(garbage, 0.0, 0.0, 0.0, 0.0)), RunError);
  // An iteration gone astray is no reason to end a run: the step is to be cut.
  const PlaneReply folded = cell->evaluate(request(nullptr, -2.0, 0.0, 0.0, 0.0));
  EXPECT_EQ(folded.response.quality, Quality::failed);
  EXPECT_NE(folded.response.message.find("at most 0.25 is taken"), std::string::npos)
      << folded.response.message;
  // And it still works.
  EXPECT_EQ(cell->evaluate(request(nullptr, 1e-4, 0.0, 0.0, 0.0)).response.quality, Quality::good);
}

TEST(Cell, AnswersAlikeWhateverTheNumbersOfItsGrains) {
  for (const CellLoop loop : {CellLoop::automatic, CellLoop::engine}) {
    CellDefinition definition = test::demo_cell();
    definition.control.loop = loop;
    const PlaneRequest asked = request(nullptr, 1e-4, 0.0, 0.0, -1e-4);
    const PlaneReply expected = make_plane_cell(definition)->evaluate(asked);
    // From 1, with gaps, backwards.
    for (Grain& grain : definition.packing.grains) grain.id = 1 + 3 * (399 - grain.id);
    EXPECT_TRUE(same_bits(make_plane_cell(definition)->evaluate(asked), expected));
    const GrainView view = make_cell_service(definition)->view();
    for (std::size_t k = 0; k < view.grains.size(); ++k)
      EXPECT_EQ(view.grains[k].id, definition.packing.grains[k].id);
  }
}

TEST(Cell, SaysWhenItDidNotComeToRest) {
  CellDefinition definition = test::demo_cell();
  definition.control.unbalanced_force_ratio = 1e-9;
  definition.control.most_relaxation_steps = 40;
  const auto cell = make_plane_cell(definition);
  const PlaneReply reply = cell->evaluate(request(nullptr, 1e-3, 0.0, 0.0, -1e-3));
  EXPECT_EQ(reply.response.quality, Quality::unreliable);
  EXPECT_NE(reply.response.message.find("did not come to rest within 40 DEM steps"), std::string::npos);
}

}  // namespace
}  // namespace polargrain::dem
