// SPDX-License-Identifier: GPL-2.0-or-later
// The skew stress of a point whose cell has free rotations: elastic with the contacts that the cell has kept, at most a share
// of the pressure of the cell, nothing where grains have parted; and the count of points that are at a limit.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <iostream>
#include <random>

#include "coupler/cells/cosserat_part.hpp"
#include "coupler/cells/packing_at_start.hpp"
#include "coupler/cells/points_at_limits.hpp"
#include "tests/unit/known_cells.hpp"

namespace polargrain::coupler {
namespace {

constexpr double kCellPressure = 1e5;
constexpr double kShare = 0.8;
constexpr double kModulusOfSkewLimit = 5e6;  // Gc
/// G, Gc, lc, lp, and the limit of the skew stress.
constexpr CosseratParameters kSkewLimited{10e6, kModulusOfSkewLimit, 3e-3, 4e-3, kShare};

Response<2> limited_cell_under(double pressure) {
  Response<2> cell;
  cell.stress << -pressure, -pressure, -pressure, 3e3, 3e3, 0.0, 0.0;
  cell.tangent.setZero();
  return cell;
}

/// Grains turned by w against the continuum: eps21 - eps12 = 2 w.
Increment<2> turned(double w) {
  Increment<2> increment;
  increment.micro_rotation = w;
  return increment;
}

double skew_of(const Response<2>& response) {
  return response.stress[k21] - response.stress[k12];
}

TEST(SkewLimit, TurningYieldsUnloadsElasticallyAndYieldsTheOtherWay) {
  CosseratPart<2> part;
  const Response<2> cell = limited_cell_under(kCellPressure);
  constexpr double kStep = 5e-4;  // the limit is reached at 8e4 / (4 Gc) = 4e-3
  double expected = 0.0;
  for (int step = 0; step < 60; ++step) {
    const double turn = step < 20 || step >= 50 ? kStep : -kStep;
    expected = std::clamp(expected + 4.0 * kModulusOfSkewLimit * turn, -kShare * kCellPressure,
                          kShare * kCellPressure);
    const Response<2> response = part.follow(turned(turn), cell, kSkewLimited, 1.0);
    ASSERT_NEAR(skew_of(response), expected, 1e-8) << step;
    // The symmetric part is the cell's, whatever the skew one is.
    ASSERT_NEAR(0.5 * (response.stress[k12] + response.stress[k21]), 3e3, 1e-9) << step;
  }
  // Twenty steps there, thirty back, ten there again: neither end nor unloading is the limit.
  EXPECT_NEAR(expected, -kShare * kCellPressure + 10 * 4.0 * kModulusOfSkewLimit * kStep + 0.0, 1e-6);
}

TEST(SkewLimit, FallsWithThePressureAndIsNothingWhereGrainsHaveParted) {
  CosseratPart<2> part;
  part.follow(turned(1.0), limited_cell_under(kCellPressure), kSkewLimited, 1.0);
  EXPECT_DOUBLE_EQ(part.skew_stress(0), kShare * kCellPressure);
  part.follow(turned(0.0), limited_cell_under(0.25 * kCellPressure), kSkewLimited, 1.0);
  EXPECT_DOUBLE_EQ(part.skew_stress(0), 0.25 * kShare * kCellPressure);
  // Pressure that returns brings no skew stress back by itself.
  part.follow(turned(0.0), limited_cell_under(kCellPressure), kSkewLimited, 1.0);
  EXPECT_DOUBLE_EQ(part.skew_stress(0), 0.25 * kShare * kCellPressure);
  const Response<2> parted = part.follow(turned(1.0), limited_cell_under(-1.0), kSkewLimited, 0.0);
  EXPECT_EQ(skew_of(parted), 0.0);
  EXPECT_EQ(parted.stress.tail<2>().norm(), 0.0);
  // Contacts that are gone answer nothing to the next turn either, and what the tangent has is numerical.
  const Response<2> next = part.follow(turned(1.0), limited_cell_under(-1.0), kSkewLimited, 0.0);
  EXPECT_EQ(skew_of(next), 0.0);
  EXPECT_EQ(next.tangent.bottomRows<2>().norm(), 0.0);
  EXPECT_DOUBLE_EQ(next.tangent(k21, k21), CosseratPart<2>::kHold * kModulusOfSkewLimit);
}

TEST(SkewLimit, StiffnessFollowsTheContactsAndItsChangeAddsNoStress) {
  CosseratPart<2> part;
  const Response<2> cell = limited_cell_under(kCellPressure);
  part.follow(turned(1e-3), cell, kSkewLimited, 0.4);
  EXPECT_DOUBLE_EQ(part.skew_stress(0),
                   4.0 * kModulusOfSkewLimit * 1e-3);  // of the contacts at the start of the increment
  const double before = part.skew_stress(0);
  Increment<2> bent;
  bent.curvature << 0.5, 0.0;
  part.follow(bent, cell, kSkewLimited, 0.4);
  EXPECT_EQ(part.skew_stress(0), before);
  EXPECT_DOUBLE_EQ(part.couple_stress.x(), 0.4 * kSkewLimited.couple_modulus() * 0.5);
  const Response<2> response = part.follow(turned(1e-3), cell, kSkewLimited, 0.9);
  EXPECT_DOUBLE_EQ(part.skew_stress(0), before + 0.4 * 4.0 * kModulusOfSkewLimit * 1e-3);
  EXPECT_DOUBLE_EQ(response.tangent(k21, k21), 0.4 * kModulusOfSkewLimit);
}

TEST(SkewLimit, AnyPathStaysWithinBothLimits) {
  std::mt19937_64 random(7);
  const auto share = [&random] { return 2.0 * static_cast<double>(random() >> 11) * 0x1p-53 - 1.0; };
  CosseratPart<2> part;
  double at_limit = 0.0;
  for (int step = 0; step < 2000; ++step) {
    Increment<2> increment = turned(0.02 * share());
    increment.displacement_gradient << 0.0, 0.01 * share(), 0.01 * share(), 0.0;
    increment.curvature << 3.0 * share(), 3.0 * share();
    increment.configuration = step % 2 == 0 ? Configuration::start : Configuration::fixed;
    const double pressure = kCellPressure * (0.9 * share() + 0.6);  // in tension now and then
    const Response<2> response =
        part.follow(increment, limited_cell_under(pressure), kSkewLimited, 0.5 + 0.5 * share());
    const double bears = std::max(0.0, pressure);
    ASSERT_LE(std::abs(skew_of(response)), kShare * bears * (1.0 + 1e-12)) << step;
    ASSERT_LE(response.stress.tail<2>().norm(), 4e-3 * bears * (1.0 + 1e-12)) << step;
    if (std::abs(skew_of(response)) > 0.999 * kShare * bears) at_limit += 1.0;
  }
  EXPECT_GT(at_limit, 200.0) << "the limit was hardly met, the test shows nothing";
}

/// A linear cell, so that only the Cosserat part is not.
Response<2> linear_limited_cell(const Increment<2>& increment) {
  Response<2> cell = limited_cell_under(kCellPressure);
  cell.tangent.topLeftCorner<5, 5>() << 3e7, 1e7, 2e6, 4e6, 4e6,  //
      9e6, 2.5e7, 1e6, -3e6, -3e6,                                //
      1e6, 2e6, 2e7, 0.0, 0.0,                                    //
      5e6, -2e6, 0.0, 8e6, 8e6,                                   //
      5e6, -2e6, 0.0, 8e6, 8e6;
  cell.stress += cell.tangent * increment.strain();
  return cell;
}

TEST(SkewLimit, TangentIsTheDerivativeOfTheStressOnAndOffTheLimit) {
  for (const double turn : {1e-3, 9e-3}) {
    CosseratPart<2> start;
    start.follow(turned(1e-3), limited_cell_under(kCellPressure), kSkewLimited, 0.7);
    Increment<2> base = turned(turn);
    base.displacement_gradient << -1e-3, 4e-4, 7e-4, -5e-4;
    base.curvature << 0.1, 0.2;
    const auto answer = [&](const Increment<2>& increment) {
      CosseratPart<2> part = start;
      return part.follow(increment, linear_limited_cell(increment), kSkewLimited, 0.5);
    };
    const Response<2> here = answer(base);
    const bool is_at_limit = turn > 5e-3;
    const double limit = kShare * -0.5 * (here.stress[k11] + here.stress[k22]);
    ASSERT_EQ(std::abs(skew_of(here)) > 0.999 * limit, is_at_limit);
    Matrix7 expected = here.tangent;
    if (is_at_limit) {
      // The stiffness that keeps the micro-rotation solvable is in the tangent alone.
      const double hold = CosseratPart<2>::kHold * kModulusOfSkewLimit;
      expected(k12, k12) -= hold;
      expected(k21, k21) -= hold;
      expected(k12, k21) += hold;
      expected(k21, k12) += hold;
    }
    double error = 0.0;
    for (const int column : {k11, k22, k12, k21, kCurvature1, kCurvature2}) {
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
      const Vector7 wrong = difference - expected.col(column);
      const double scale = column < kCurvature1 ? 1e7 : kSkewLimited.couple_modulus() / 4e-3;
      error = std::max({error, wrong.head<5>().norm() / scale, wrong.tail<2>().norm() / (4e-3 * scale)});
    }
    std::cout << "[figure] tangent " << (is_at_limit ? "at" : "below")
              << " the limit of the skew stress against central differences: " << error << '\n';
    // Rounding of 1e5 Pa over 1e-6, over 1e7.
    EXPECT_LT(error, 1e-8);
  }
}

TEST(SkewLimit, ALimitOfZeroLeavesNoStressAndASolvableTangent) {
  CosseratParameters frictionless = kSkewLimited;
  frictionless.skew_limit = 0.0;
  CosseratPart<2> part;
  part.pressures(0, 0) = kCellPressure;
  const Response<2> response =
      part.follow(turned(0.01), limited_cell_under(kCellPressure), frictionless, 1.0);
  EXPECT_EQ(skew_of(response), 0.0);
  EXPECT_GT(response.tangent(k21, k21), 0.0);
  EXPECT_TRUE(part.reached(frictionless, 1.0).skew);
  EXPECT_EQ(part.skew_mobilisation(frictionless), 0.0);
}

TEST(SkewLimit, InLargeDeformationTheCoupleStressTurnsAtItsLimitAndTheSkewStressStays) {
  CosseratPart<2> part;
  Increment<2> bent = turned(0.1);
  bent.curvature << 100.0, 0.0;
  part.follow(bent, limited_cell_under(kCellPressure), kSkewLimited, 1.0);
  ASSERT_DOUBLE_EQ(part.couple_stress.x(), 4e-3 * kCellPressure);
  ASSERT_DOUBLE_EQ(part.skew_stress(0), kShare * kCellPressure);
  Increment<2> turn;  // body and grains, by a quarter: R - I
  turn.displacement_gradient << -1.0, -1.0, 1.0, -1.0;
  turn.micro_rotation = 0.5 * M_PI;
  turn.configuration = Configuration::start;
  part.follow(turn, limited_cell_under(kCellPressure), kSkewLimited, 1.0);
  EXPECT_NEAR(part.couple_stress.y(), 4e-3 * kCellPressure, 1e-9);
  EXPECT_NEAR(part.couple_stress.x(), 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(part.skew_stress(0), kShare * kCellPressure);
}

TEST(SkewLimit, MobilisationAndCountsAreThoseOfThePoint) {
  const PackingAtStart<2> packing = [] {
    PlaneReply reply;
    reply.response = limited_cell_under(kCellPressure);
    reply.diagnostics.contacts = 200;
    return PackingAtStart<2>(reply);
  }();
  CellDiagnostics half;
  half.contacts = 100;
  EXPECT_DOUBLE_EQ(packing.kept(half), 0.5);
  std::vector<CosseratPart<2>> points(5, packing.part());
  points[0].follow(turned(1e-3), limited_cell_under(kCellPressure), kSkewLimited,
                   1.0);  // 2e4 of 8e4
  EXPECT_NEAR(points[0].skew_mobilisation(kSkewLimited), 0.25, 1e-12);
  points[1].follow(turned(1.0), limited_cell_under(kCellPressure), kSkewLimited, 1.0);
  EXPECT_EQ(points[1].skew_mobilisation(kSkewLimited), 1.0);
  Increment<2> bent;
  bent.curvature << 100.0, 0.0;
  points[2].follow(bent, limited_cell_under(kCellPressure), kSkewLimited, 1.0);
  bent.micro_rotation = 1.0;
  points[3].follow(bent, limited_cell_under(kCellPressure), kSkewLimited, 1.0);
  points[4].follow(bent, limited_cell_under(1e-4 * kCellPressure), kSkewLimited, 0.0);
  std::vector<LimitsReached> reached;
  for (const CosseratPart<2>& point : points)
    reached.push_back(point.reached(kSkewLimited, packing.least_pressure()));
  PointsAtLimits counts(true);
  counts.count(reached);
  const auto figure = [&counts](const std::string& name) {
    for (const fem::Figure& figure : counts.figures())
      if (figure.name == name) return figure.value;
    return -1.0;
  };
  EXPECT_EQ(figure("points_parted"), 1.0);
  EXPECT_EQ(figure("at_skew_limit"), 2.0);
  EXPECT_EQ(figure("at_couple_limit"), 2.0);
  EXPECT_EQ(figure("rotation_held"), 2.0);
  // A later step where nothing is at a limit keeps what has been.
  MemoryArchive archive;
  counts.save(archive);
  PointsAtLimits resumed(true);
  resumed.restore(archive);
  for (PointsAtLimits* const both : {&counts, &resumed}) {
    both->count(std::vector<LimitsReached>(5));
    EXPECT_EQ(both->text(),
              "of 5 points at the end (in any step): 0 have grains that have parted (at most 1); 0 carry the "
              "largest skew stress that their grains bear (at most 2); 0 carry the largest couple stress (at "
              "most 2); 0 have a micro-rotation that is held numerically (at most 2)");
  }
}

class LimitedSkewAdaptiveTest : public AdaptiveMaterialTest {};

TEST_F(LimitedSkewAdaptiveTest, AdaptiveHasTheSameSkewStressAsACellOfItsOwn) {
  constexpr CosseratParameters kSand{16e6, 14e6, 0.02, 2e-3, 0.5};
  AdaptiveMaterial<2> sand(cells_.calls(), kSand, {0.0, 0.0, 1});
  sand.allocate(1);
  CosseratPart<2> part;
  Eigen::Matrix2d strain = Eigen::Matrix2d::Zero();
  bool was_limited = false;
  for (int step = 0; step < 6; ++step) {
    Increment<2> increment = increment_of<2>(compression(1e-4));
    increment.micro_rotation = step < 4 ? 4e-4 : -1e-4;
    strain += compression(1e-4);
    const Vector7 expected = part.follow(increment, cells_.at(strain).response, kSand, 1.0).stress;
    was_limited = was_limited || part.reached(kSand, 1.0).skew;
    Response<2> response;
    sand.evaluate({&increment, 1}, {&response, 1});
    ASSERT_TRUE(sand.confirm());
    sand.commit();
    EXPECT_NEAR(skew_of(response), expected[k21] - expected[k12], 1e-6) << step;
    std::vector<double> fields(sand.field_names().size());
    sand.fields(0, fields);
    EXPECT_NEAR(fields[fields.size() - 2], part.skew_mobilisation(kSand), 1e-9);
  }
  EXPECT_TRUE(was_limited);
  EXPECT_EQ(figure(sand, "at_skew_limit_most"), 1.0);
  EXPECT_EQ(figure(sand, "at_skew_limit"), 0.0);
}

}  // namespace
}  // namespace polargrain::coupler
