// SPDX-License-Identifier: GPL-2.0-or-later
// The noise that a cell's stress is given.
#include <gtest/gtest.h>

#include "coupler/cells/cell_noise.hpp"
#include "coupler/cells/point_cell.hpp"

namespace polargrain::coupler {
namespace {

TEST(CellNoise, IsThePressureTimesTheUnbalancedRatioOverTheRootOfTheGrains) {
  PlaneReply reply;
  reply.response.stress << -80e3, -220e3, -100e3, 5e3, 5e3, 1.0, 1.0;
  reply.diagnostics.unbalanced_force_ratio = 5e-3;
  reply.diagnostics.contacts = 800;
  reply.diagnostics.coordination_number = 4.0;  // so 400 grains
  const StressNoise noise = noise_of(reply, 0.0);
  EXPECT_DOUBLE_EQ(noise.symmetric, 5e-3 * 150e3 / 20.0);
  EXPECT_EQ(noise.skew, 0.0);
  EXPECT_EQ(noise.couple, 0.0);
  reply.diagnostics.unbalanced_moment_ratio = 2e-3;
  const StressNoise controlled = noise_of(reply, 5e-3);
  EXPECT_DOUBLE_EQ(controlled.symmetric, noise.symmetric);
  EXPECT_DOUBLE_EQ(controlled.skew, 2e-3 * 150e3 / 20.0);
  EXPECT_DOUBLE_EQ(controlled.couple, 2e-3 * 150e3 / 20.0 * 5e-3);
}

TEST(CellNoise, IsNoneWithoutContacts) {
  EXPECT_TRUE(noise_of(PlaneReply{}, 5e-3).is_zero());
}

}  // namespace
}  // namespace polargrain::coupler
