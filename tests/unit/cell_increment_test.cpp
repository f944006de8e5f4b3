// SPDX-License-Identifier: GPL-2.0-or-later
// The motion of a point as its cell takes it, in small and in large deformation, and the parts of the answer that turn.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "coupler/cells/cell_increment.hpp"
#include "coupler/cells/cosserat_part.hpp"

namespace polargrain::coupler {
namespace {

Increment<2> some_increment() {
  Increment<2> increment;
  increment.displacement_gradient << 1e-3, 7e-3, -2e-3, -4e-3;
  increment.micro_rotation = 3e-3;
  increment.curvature << 0.2, -0.5;
  return increment;
}

/// A rigid rotation of box and grains.
Increment<2> turn_by(double angle) {
  Increment<2> turn;
  turn.displacement_gradient = Eigen::Rotation2Dd(angle).toRotationMatrix() - Eigen::Matrix2d::Identity();
  turn.micro_rotation = angle;
  turn.configuration = Configuration::start;
  return turn;
}

TEST(CellIncrement, InSmallDeformationARotationIsNothing) {
  Increment<2> turn;
  turn.displacement_gradient << 0.0, -0.05, 0.05, 0.0;
  turn.micro_rotation = 0.05;
  EXPECT_TRUE(is_zero(increment_for_cell(turn)));
}

TEST(CellIncrement, InSmallDeformationTheCellFeelsTheSameStrainAndDoesNotTurn) {
  const Increment<2> told = increment_for_cell(some_increment());
  EXPECT_LT((told.strain() - some_increment().strain()).norm(), 1e-17);
  EXPECT_EQ(told.displacement_gradient(0, 1), told.displacement_gradient(1, 0));
}

TEST(CellIncrement, InLargeDeformationTheBoxTurnsByAllOfARotation) {
  for (const double angle : {0.01, 0.6, 2.0}) {
    const Increment<2> told = increment_for_cell(turn_by(angle));
    const Eigen::Matrix2d turned = Eigen::Matrix2d::Identity() + told.displacement_gradient;
    EXPECT_LT((turned - Eigen::Rotation2Dd(angle).toRotationMatrix()).norm(), 1e-14) << angle;
    EXPECT_NEAR(told.micro_rotation, angle, 1e-15 + 1e-15 * angle) << angle;
  }
}

TEST(CosseratPart, CoupleStressTurnsInLargeDeformationAndTheSkewStressStays) {
  const CosseratParameters cosserat{40e6, 10e6, 0.02};
  CosseratPart<2> part;
  part.follow(some_increment(), Response<2>{}, cosserat, 1.0);
  const Eigen::Vector2d before = part.couple_stress;
  const double skew = part.skew_stress(0);
  Increment<2> turn = turn_by(0.5 * M_PI);
  part.follow(turn, Response<2>{}, cosserat, 1.0);
  EXPECT_NEAR(part.couple_stress.x(), -before.y(), 1e-12 * before.norm());
  EXPECT_NEAR(part.couple_stress.y(), before.x(), 1e-12 * before.norm());
  EXPECT_EQ(part.skew_stress(0), skew);
  turn.configuration = Configuration::fixed;
  const Eigen::Vector2d turned = part.couple_stress;
  part.follow(turn, Response<2>{}, cosserat, 1.0);
  EXPECT_EQ(part.couple_stress, turned);
}

}  // namespace
}  // namespace polargrain::coupler
