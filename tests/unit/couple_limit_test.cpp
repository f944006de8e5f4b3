// SPDX-License-Identifier: GPL-2.0-or-later
// The couple stress of a point whose cell has free rotations, with a limit: lp times the pressure of the cell.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <iostream>

#include "coupler/cells/cosserat_part.hpp"
#include "tests/unit/known_cells.hpp"

namespace polargrain::coupler {
namespace {

constexpr double kPressure = 1e5;
constexpr double kLimit = 4e-3 * kPressure;  // N/m
constexpr CosseratParameters kLimited{10e6, 5e6, 3e-3, 4e-3};
const double kCouple = kLimited.couple_modulus();  // 180 N

/// A cell under that pressure that answers nothing to any strain.
Response<2> cell_under(double pressure) {
  Response<2> cell;
  cell.stress << -pressure, -pressure, -pressure, 0.0, 0.0, 0.0, 0.0;
  cell.tangent.setZero();
  return cell;
}

Increment<2> bending(double k1, double k2) {
  Increment<2> increment;
  increment.curvature << k1, k2;
  return increment;
}

TEST(CoupleLimit, BendingYieldsUnloadsElasticallyAndYieldsTheOtherWay) {
  CosseratPart<2> part;
  const Response<2> cell = cell_under(kPressure);
  constexpr double kStep = 0.1;  // rad/m; the limit is reached at 400 / 180 = 2.2
  double expected = 0.0;
  for (int step = 0; step < 120; ++step) {
    const double turn = step < 40 || step >= 100 ? kStep : -kStep;
    expected = std::clamp(expected + kCouple * turn, -kLimit, kLimit);
    const Response<2> response = part.follow(bending(0.6 * turn, -0.8 * turn), cell, kLimited, 1.0);
    // Sums of 120 doubles of some hundred N/m.
    ASSERT_NEAR(response.stress[kCurvature1], 0.6 * expected, 1e-10) << step;
    ASSERT_NEAR(response.stress[kCurvature2], -0.8 * expected, 1e-10) << step;
    ASSERT_LE(response.stress.tail<2>().norm(), kLimit * (1.0 + 1e-15)) << step;
  }
  // 4 rad/m there, 6 back, 2 there again: neither end nor unloading is the limit.
  EXPECT_NEAR(expected, -kLimit + kCouple * 20 * kStep, 1e-9);
}

TEST(CoupleLimit, FallsWithThePressureAndIsNothingInTension) {
  CosseratPart<2> part;
  part.follow(bending(10.0, 0.0), cell_under(kPressure), kLimited, 1.0);
  EXPECT_DOUBLE_EQ(part.couple_stress.x(), kLimit);
  EXPECT_DOUBLE_EQ(
      part.follow(bending(1e-9, 0.0), cell_under(0.25 * kPressure), kLimited, 1.0).stress[kCurvature1],
      0.25 * kLimit);
  // Pressure that returns brings no couple stress back by itself.
  EXPECT_NEAR(part.follow(bending(1e-9, 0.0), cell_under(kPressure), kLimited, 1.0).stress[kCurvature1],
              0.25 * kLimit, 1e-6);
  const Response<2> pulled = part.follow(bending(1.0, 1.0), cell_under(-1.0), kLimited, 1.0);
  EXPECT_EQ(pulled.stress.tail<2>().norm(), 0.0);
  // But for the hold, which adds no stress.
  EXPECT_NEAR(pulled.tangent.bottomRows<2>().norm(), CosseratPart<2>::kHold * kCouple, 1e-9);
}

TEST(CoupleLimit, WithoutOneNothingChanges) {
  CosseratParameters elastic = kLimited;
  elastic.plastic_length.reset();
  CosseratPart<2> part;
  const Response<2> response = part.follow(bending(100.0, -50.0), cell_under(kPressure), elastic, 1.0);
  EXPECT_EQ(response.stress[kCurvature1], kCouple * 100.0);
  EXPECT_EQ(response.tangent(kCurvature2, kCurvature2), kCouple);
}

TEST(CoupleLimit, AFailedAnswerHasNone) {
  CosseratPart<2> part;
  Response<2> failed = cell_under(kPressure);
  failed.quality = Quality::failed;
  EXPECT_EQ(part.follow(bending(100.0, 0.0), failed, kLimited, 1.0).quality, Quality::failed);
}

/// A linear cell, so that only the couple stress is not.
Response<2> linear_cell(const Increment<2>& increment) {
  Response<2> cell = cell_under(kPressure);
  cell.tangent.topLeftCorner<5, 5>() << 3e7, 1e7, 2e6, 4e6, 4e6,  //
      9e6, 2.5e7, 1e6, -3e6, -3e6,                                //
      1e6, 2e6, 2e7, 0.0, 0.0,                                    //
      5e6, -2e6, 0.0, 8e6, 8e6,                                   //
      5e6, -2e6, 0.0, 8e6, 8e6;
  cell.stress += cell.tangent * increment.strain();
  return cell;
}

TEST(CoupleLimit, TangentIsTheDerivativeOfTheStress) {
  CosseratPart<2> start;
  start.follow(bending(1.5, -1.0), cell_under(kPressure), kLimited, 1.0);
  Increment<2> base = bending(1.0, 2.5);
  base.displacement_gradient << -1e-3, 4e-4, 7e-4, -5e-4;
  base.micro_rotation = 2e-4;
  const auto answer = [&](const Increment<2>& increment) {
    CosseratPart<2> part = start;
    return part.follow(increment, linear_cell(increment), kLimited, 1.0);
  };
  const Response<2> here = answer(base);
  ASSERT_NEAR(here.stress.tail<2>().norm(), 4e-3 * -0.5 * (here.stress[k11] + here.stress[k22]), 1e-9);
  Matrix7 tangent = here.tangent;  // without the hold, which adds no stress
  const Eigen::Vector2d direction = here.stress.tail<2>().normalized();
  tangent.bottomRightCorner<2, 2>() -= CosseratPart<2>::kHold * kCouple * direction * direction.transpose();
  double error = 0.0;
  for (const int column : {k11, k22, k12, k21, kCurvature1, kCurvature2}) {
    // Of the strain: a step of 1e-6, of the curvature one of 1e-3 rad/m.
    const double step = column < kCurvature1 ? 1e-6 : 1e-3;
    Vector7 strain = Vector7::Zero();
    strain[column] = step;
    Increment<2> ahead = base;
    Increment<2> behind = base;
    Eigen::Matrix2d gradient;
    gradient << strain[k11], strain[k21], strain[k12], strain[k22];
    ahead.displacement_gradient += gradient;
    behind.displacement_gradient -= gradient;
    ahead.curvature += strain.tail<2>();
    behind.curvature -= strain.tail<2>();
    const Vector7 difference = (answer(ahead).stress - answer(behind).stress) / (2.0 * step);
    const Vector7 wrong = difference - tangent.col(column);
    // Stresses against the modulus of the cell; couple stresses against lp times it, or the couple modulus.
    const double scale = column < kCurvature1 ? 1e7 : kCouple / 4e-3;
    error = std::max({error, wrong.head<5>().norm() / scale, wrong.tail<2>().norm() / (4e-3 * scale)});
  }
  std::cout << "[figure] tangent at the limit against central differences: " << error << '\n';
  // Rounding of 1e5 Pa over 1e-6, over 1e7: 1e-12 and some; the third derivative of the return: (1e-3/3)^2.
  EXPECT_LT(error, 1e-6);
}

class LimitedAdaptiveTest : public AdaptiveMaterialTest {};

TEST_F(LimitedAdaptiveTest, AdaptiveHasTheSameCoupleStressAndKeepsItsHistory) {
  constexpr CosseratParameters kSand{16e6, 14e6, 0.02, 2e-3};
  Increment<2> increment = bending(0.02, -0.03);
  increment.displacement_gradient = compression(1e-4);
  const auto made = [&] {
    AdaptiveMaterial<2> sand(cells_.calls(), kSand, {0.0, 0.0, 1});
    sand.allocate(1);
    return sand;
  };
  AdaptiveMaterial<2> sand = made();
  AdaptiveMaterial<2> resumed = made();
  CosseratPart<2> part;
  Eigen::Matrix2d strain = Eigen::Matrix2d::Zero();
  for (int step = 0; step < 6; ++step) {
    if (step == 4) increment.curvature *= -0.1;  // unloading, whose stress is that of the whole history
    if (step == 3) {
      MemoryArchive archive;
      sand.save(archive);
      resumed.restore(archive);
    }
    strain += compression(1e-4);
    const Vector7 expected = part.follow(increment, cells_.at(strain).response, kSand, 1.0).stress;
    Response<2> response;
    sand.evaluate({&increment, 1}, {&response, 1});
    ASSERT_TRUE(sand.confirm());
    sand.commit();
    // Of 200 N/m; the stress of the cell is carried along its tangent over nothing.
    EXPECT_LT((response.stress - expected).tail<2>().norm(), 1e-6) << step;
    if (step < 3) continue;
    Response<2> again;
    resumed.evaluate({&increment, 1}, {&again, 1});
    ASSERT_TRUE(resumed.confirm());
    resumed.commit();
    EXPECT_EQ(std::memcmp(again.stress.data(), response.stress.data(), sizeof(Vector7)), 0) << step;
  }
  // Four steps of 460 N/m each up to the limit of some 206, two of 46 back.
  EXPECT_LT(part.couple_stress.norm(), 150.0);
}

}  // namespace
}  // namespace polargrain::coupler
