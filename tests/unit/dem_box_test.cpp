// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>

#include "common/error.hpp"
#include "dem/cell/box_motion.hpp"

namespace polargrain::dem {
namespace {

Eigen::Matrix2d laboratory(const Box& box) {
  return box.frame() * box.base_vectors();
}

const Eigen::Matrix2d kBase = (Eigen::Matrix2d() << 0.2, 0.03, 0.05, 0.19).finished();

TEST(Box, HoldsAnyLatticeInAFrameOfItsOwn) {
  const Box box = Box::from_base_vectors(kBase);
  EXPECT_LT((laboratory(box) - kBase).norm(), 1e-16);
  EXPECT_EQ(box.base_vectors()(1, 0), 0.0);
  EXPECT_NEAR(box.area(), kBase.determinant(), 1e-17);
}

TEST(Box, ReducedIsTheSameLattice) {
  Box box = Box::from_base_vectors(kBase);
  box.tilt += 3.0 * box.length_x;
  const Box reduced = box.reduced();
  EXPECT_LE(std::abs(reduced.tilt), 0.5 * reduced.length_x);
  // The second base vectors differ by a whole number of first ones.
  const double difference = (box.tilt - reduced.tilt) / box.length_x;
  EXPECT_NEAR(difference, std::round(difference), 1e-13);
}

TEST(BoxPath, EndsWhereTheDisplacementGradientLeads) {
  Eigen::Matrix2d h;
  h << 0.01, 0.2, -0.1, -0.02;
  const BoxPath path(Box::from_base_vectors(kBase), h, 37);
  EXPECT_LT((laboratory(path.at(0)) - kBase).norm(), 1e-16);
  EXPECT_LT((laboratory(path.at(37)) - (Eigen::Matrix2d::Identity() + h) * kBase).norm(), 1e-16);
}

TEST(BoxMotion, CarriesAGrainWithTheLattice) {
  Eigen::Matrix2d h;
  h << 0.01, 0.2, -0.1, -0.02;
  const int steps = 25;
  const double time_step = 1e-3;
  const BoxPath path(Box::from_base_vectors(kBase), h, steps);
  BoxMotion motion(path, std::nullopt, time_step);
  // A grain that gets what the box adds to its velocity and nothing else stays where it is in the lattice.
  const Eigen::Vector2d share(0.3, 0.8);
  Eigen::Vector2d place = motion.box().base_vectors() * share;
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  double rotation = motion.box().rotation;
  double fastest = 0.0;
  double first = 0.0;
  for (int step = 1; step <= steps + 3; ++step) {
    motion.advance();
    velocity += motion.change_of_gradient() * place;
    EXPECT_LT((velocity - motion.gradient_before() * place).norm(), 1e-14 / time_step);
    place += time_step * velocity;
    EXPECT_LT((velocity - motion.gradient() * place).norm(), 1e-14 / time_step);
    EXPECT_LT((place - motion.box().base_vectors() * share).norm(), 1e-14);
    rotation += motion.turn();
    fastest = std::max(fastest, motion.rate().norm());
    if (step == 1) first = motion.rate().norm();
  }
  EXPECT_NEAR(rotation, path.at(steps).rotation, 1e-15);
  EXPECT_LT(velocity.norm(), 1e-14 / time_step);
  EXPECT_FALSE(motion.moving());
  // It starts at rest: the first step moves little (sine squared: (pi/steps)^2 / 3 of the mean).
  EXPECT_LT(first, 0.02 * fastest);
}

TEST(BoxPath, PureRotationOnlyTurnsTheFrame) {
  const double angle = 0.3;
  Eigen::Matrix2d h;
  h << std::cos(angle) - 1.0, -std::sin(angle), std::sin(angle), std::cos(angle) - 1.0;
  const Box start = Box::from_base_vectors(kBase);
  const BoxPath path(start, h, 10);
  // All the way, not only at its end.
  for (int step = 0; step <= 10; ++step)
    EXPECT_LT((path.at(step).base_vectors() - start.base_vectors()).norm(), 1e-15) << step;
  EXPECT_LT((path.at(10).base_vectors() - start.base_vectors()).norm(), 1e-15);
  EXPECT_NEAR(path.at(10).rotation - start.rotation, angle, 1e-15);
}

TEST(BoxPath, RefusesToFoldTheBox) {
  const Eigen::Matrix2d h = -1.5 * Eigen::Matrix2d::Identity();
  EXPECT_THROW(BoxPath(Box::from_base_vectors(kBase), h, 10), RunError);
}

}  // namespace
}  // namespace polargrain::dem
