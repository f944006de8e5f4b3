// SPDX-License-Identifier: GPL-2.0-or-later
// The pieces that an adaptive material is made of.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "coupler/adaptivity/audits.hpp"
#include "coupler/adaptivity/error_bound.hpp"
#include "coupler/adaptivity/error_estimate.hpp"
#include "coupler/adaptivity/grain_measure.hpp"
#include "coupler/adaptivity/leaders.hpp"
#include "coupler/cells/cell_increment.hpp"
#include "coupler/cells/linearised.hpp"
#include "coupler/cells/successive.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

Eigen::Matrix2d gradient(double h11, double h12, double h21, double h22) {
  Eigen::Matrix2d h;
  h << h11, h12, h21, h22;
  return h;
}

TEST(Linearised, OffsetsLeadFromOnePlaceToTheOther) {
  Increment<2> first = increment_of<2>(gradient(0.1, -0.2, 0.05, -0.3));
  Increment<2> second = increment_of<2>(gradient(-0.05, 0.3, 0.1, 0.2));
  first.micro_rotation = 0.02;
  second.micro_rotation = -0.05;
  first.curvature << 0.3, -0.1;
  second.curvature << -0.2, 0.4;
  const Increment<2> both = followed_by(first, second);
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d after_first = one + first.displacement_gradient;
  // (I + second)(I + first), computed the long way; entries of order one, so a few roundings of 1e-16.
  EXPECT_LT(((one + second.displacement_gradient) * after_first - one - both.displacement_gradient).norm(),
            1e-15);
  // The rotation at a place X: w = w1 + k1 . X + w2 + k2 . (I + first) X.
  const Eigen::Vector2d place(0.7, -1.3);
  const double rotation = first.curvature.dot(place) + second.curvature.dot(after_first * place);
  EXPECT_NEAR(both.curvature.dot(place), rotation, 1e-15);
  EXPECT_DOUBLE_EQ(both.micro_rotation, -0.03);
  const Increment<2> back = offset_between(first, both);
  EXPECT_LT((back.displacement_gradient - second.displacement_gradient).norm(), 1e-15);
  EXPECT_LT((back.curvature - second.curvature).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(back.micro_rotation, second.micro_rotation);
  EXPECT_TRUE(is_zero(offset_between(both, both)));
}

TEST(Linearised, ARotationTurnsSkewAndCoupleStressToo) {
  Response<2> answer;
  answer.stress << -1e5, -3e5, -2e5, 6e4, 2e4, 150.0, -40.0;
  const double angle = 1e-4;
  Increment<2> turn = increment_of<2>(gradient(0.0, -angle, angle, 0.0));
  turn.micro_rotation = angle;  // grains and box turn alike: no strain
  const Vector7 carried = linearised_stress(answer, turn);
  const Vector7 exact = fem::rotated(answer.stress, angle);
  // The rest is of second order: angle^2 times differences of 2e5 Pa and 200 N/m.
  EXPECT_LT((carried - exact).head<5>().norm(), 5e-3);
  EXPECT_LT((carried - exact).tail<2>().norm(), 5e-6);
  EXPECT_GT((exact - answer.stress).tail<2>().norm(), 1e-2) << "the test would see nothing";
}

TEST(Linearised, ARotationTurnsTheStress) {
  Response<2> answer;
  answer.stress << -1e5, -3e5, -2e5, 4e4, 4e4, 0.0, 0.0;
  const double angle = 1e-4;
  const Vector7 carried = linearised_stress(answer, increment_of<2>(gradient(0.0, -angle, angle, 0.0)));
  Eigen::Matrix2d stress;
  stress << -1e5, 4e4, 4e4, -3e5;
  const Eigen::Matrix2d rotation =
      gradient(std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle));
  const Eigen::Matrix2d exact = rotation * stress * rotation.transpose();
  // The rest is of second order: angle^2 times the stress difference of 2e5 Pa, 2e-3 Pa.
  EXPECT_NEAR(carried[k11], exact(0, 0), 5e-3);
  EXPECT_NEAR(carried[k22], exact(1, 1), 5e-3);
  EXPECT_NEAR(carried[k12], exact(0, 1), 5e-3);
  EXPECT_GT(std::abs(exact(0, 1) - 4e4), 10.0) << "the test would see nothing";
}

TEST(ErrorEstimate, KnowsNothingAtFirstAndLearnsFromARun) {
  Matrix7 elastic = Matrix7::Zero();
  elastic.topLeftCorner<2, 2>() << 3e7, 1e7, 1e7, 3e7;
  const ErrorEstimate<2> estimate(GrainMeasure<2>(), elastic, 1e-5);
  Response<2> start;
  start.tangent = elastic;
  Departure<2> packing;
  const auto times = [](double factor) {
    return increment_of<2>(gradient(factor * 1e-3, 0.0, 0.0, -factor * 1e-3));
  };
  const Increment<2> offset = times(1.0);
  EXPECT_EQ(estimate.of(start, packing, Increment<2>{}), 0.0);
  EXPECT_EQ(estimate.of(start, packing, offset), HUGE_VAL);
  Response<2> end = start;
  end.stress = linearised_stress(start, offset);
  end.stress[k11] -= 300.0;  // what the run shows and the tangent did not
  end.stress[k22] += 400.0;
  const Departure<2> moved = estimate.learn(start, end, offset, packing);
  EXPECT_DOUBLE_EQ(estimate.of(start, packing, offset), 500.0);
  EXPECT_DOUBLE_EQ(estimate.of(end, moved, offset), 500.0);
  // The law of growth: power 3/2 inside of what was seen, the square beyond.
  EXPECT_NEAR(estimate.of(start, packing, times(0.25)), 500.0 / 8.0, 1e-9);
  EXPECT_NEAR(estimate.of(start, packing, times(2.0)), 2000.0, 1e-9);
}

TEST(ErrorEstimate, UnloadingIsJudgedByTheElasticTangent) {
  Matrix7 elastic = Matrix7::Zero();
  elastic(k11, k11) = elastic(k22, k22) = 3e7;
  Response<2> soft;
  soft.tangent = 0.1 * elastic;
  const Increment<2> onward = increment_of<2>(gradient(-1e-3, 0.0, 0.0, 1e-3));
  const Increment<2> back = increment_of<2>(gradient(1e-3, 0.0, 0.0, -1e-3));
  const Departure<2> departure{1.0, onward.strain().norm(), onward.strain().normalized()};
  const ErrorEstimate<2> estimate(GrainMeasure<2>(), elastic, 1e-5);
  EXPECT_NEAR(estimate.of(soft, departure, onward), 1.0, 1e-9);
  // Half of the stress between both tangents, 0.9 * 3e7 * 1e-3 Pa in two components.
  EXPECT_NEAR(estimate.of(soft, departure, back), 1.0 + 0.5 * std::sqrt(2.0) * 27e3, 1e-6);
}

TEST(ErrorEstimate, AWayOutAndBackThatOneHasGoneAloneLeavesAnErrorInItsHistory) {
  Matrix7 elastic = Matrix7::Zero();
  elastic(k11, k11) = elastic(k22, k22) = 3e7;
  Response<2> soft;
  soft.tangent = 0.1 * elastic;
  const Increment<2> along = increment_of<2>(gradient(-3e-4, 0.0, 0.0, 4e-4));
  const Departure<2> departure{1.0, along.strain().norm(), along.strain().normalized()};
  const ErrorEstimate<2> estimate(GrainMeasure<2>(), elastic, 1e-5);
  EXPECT_DOUBLE_EQ(estimate.onward(departure, along), 5e-4);
  EXPECT_EQ(estimate.onward(departure, increment_of<2>(gradient(3e-4, 0.0, 0.0, -4e-4))), 0.0);
  const auto of = [&](Excursion point, Excursion cell) {
    return estimate.of_history(soft, departure, point, cell) / (0.5 * 0.9 * 3e7);
  };
  EXPECT_DOUBLE_EQ(of({3e-3, 1e-3}, {0.0, 0.0}), 1e-3)
      << "a cell that has not moved, carried part of the way";
  EXPECT_DOUBLE_EQ(of({3e-3, 3e-3}, {0.0, 0.0}), 3e-3) << "the same, all of it taken back";
  EXPECT_DOUBLE_EQ(of({3e-3, 1e-3}, {2e-3, 0.0}), 1e-3) << "a cell that went straight to where the point is";
  EXPECT_DOUBLE_EQ(of({2e-3, 0.0}, {3e-3, 2e-3}), 1e-3) << "a cell that was farther than the point";
  EXPECT_EQ(of({3e-3, 1e-3}, {3e-3, 2e-3}), 0.0)
      << "both turned at one place, where they are now is no matter";
  EXPECT_EQ(of({3e-3, 0.0}, {2e-3, 0.0}), 0.0) << "neither has turned";
}

TEST(GrainMeasure, AVolumeChangeCountsLessAndARotationNothing) {
  const auto size = [](double h11, double h12, double h21, double h22) {
    return GrainMeasure<2>().size(increment_of<2>(gradient(h11, h12, h21, h22)));
  };
  EXPECT_DOUBLE_EQ(size(0.0, 3e-3, 4e-3, 0.0), std::sqrt(2.0) * 3.5e-3);
  EXPECT_EQ(size(0.0, -2e-2, 2e-2, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(size(1e-3, 0.0, 0.0, 1e-3), 0.35 * std::sqrt(2.0) * 1e-3);
}

TEST(GrainMeasure, ControlledGrainsCountRelativeRotationAndCurvatureInDiameters) {
  constexpr double kDiameter = 0.01;
  const GrainMeasure<2> measure(kDiameter);
  Increment<2> turned = increment_of<2>(gradient(0.0, -2e-3, 2e-3, 0.0));
  turned.micro_rotation = 2e-3;  // box and grains turn alike
  EXPECT_EQ(measure.size(turned), 0.0);
  turned.micro_rotation = 5e-3;  // skew strain: e12 = -3e-3, e21 = 3e-3
  EXPECT_DOUBLE_EQ(measure.size(turned), std::sqrt(2.0) * 3e-3);
  Increment<2> bent;
  bent.curvature << 0.3, 0.4;
  EXPECT_DOUBLE_EQ(measure.size(bent), 0.5 * kDiameter);
  EXPECT_DOUBLE_EQ(measure.unmeasured(measure.strain(bent))[kCurvature2], 0.4);
  EXPECT_EQ(GrainMeasure<2>().size(bent), 0.0) << "grains whose rotations are free feel no curvature";
  Vector7 stress;
  stress << 0.0, 0.0, 7.0, 2e3, 4e3, 30.0, -40.0;
  EXPECT_DOUBLE_EQ(measure.stress(stress), std::sqrt(4e6 + 16e6 + 25e6));
  EXPECT_DOUBLE_EQ(GrainMeasure<2>().stress(stress), std::sqrt(18e6));
  // The measured strain does the work: stress . strain = (m / d) (kappa d).
  Vector7 measured = stress;
  measured.tail<2>() /= kDiameter;
  EXPECT_DOUBLE_EQ(measured.dot(measure.strain(bent)), stress.dot(bent.strain()));
}

TEST(Leaders, EveryPointIsCoveredAndFewLead) {
  // Points on a line, three clumps 1 wide and 10 apart; a leader covers what is within 1.
  std::vector<double> places;
  for (int clump = 0; clump < 3; ++clump) {
    for (int k = 0; k < 700; ++k) places.push_back(10.0 * clump + k / 700.0);
  }
  std::vector<std::size_t> points(places.size());
  std::iota(points.begin(), points.end(), 0u);
  const auto covers = [&](std::size_t a, std::size_t b) { return std::abs(places[a] - places[b]) <= 1.0; };
  const std::vector<std::size_t> leaders = choose_leaders(points, covers);
  EXPECT_EQ(leaders.size(), 3u);
  for (const std::size_t point : points) {
    EXPECT_TRUE(std::any_of(leaders.begin(), leaders.end(), [&](std::size_t l) { return covers(l, point); }));
  }
  EXPECT_EQ(choose_leaders(points, covers), leaders);
  const std::vector<std::size_t> some{4, 9, 2};
  EXPECT_EQ(choose_leaders(some, [](std::size_t, std::size_t) { return false; }), some);
}

TEST(Audits, DrawsAreEvenAndAlwaysTheSame) {
  int chosen = 0;
  for (std::uint64_t point = 0; point < 1000; ++point) {
    for (std::uint64_t step = 0; step < 20; ++step) chosen += hashed_share(1, point, step) < 0.02 ? 1 : 0;
  }
  // 20000 draws of 2 %: 400, with a standard deviation of 20.
  EXPECT_NEAR(chosen, 400, 60);
  // Fixed for ever: restarts and other machines must draw alike. Value of this implementation of SplitMix64.
  EXPECT_EQ(hashed_share(1, 2, 3), hashed_share(1, 2, 3));
  EXPECT_NE(hashed_share(1, 2, 3), hashed_share(1, 3, 2));
  EXPECT_NE(hashed_share(1, 2, 3), hashed_share(2, 2, 3));
}

TEST(Audits, StatisticsOfKnownErrors) {
  MeasuredErrors errors;
  EXPECT_EQ(errors.mean(), 0.0);
  EXPECT_EQ(errors.largest(), 0.0);
  for (int k = 100; k >= 1; --k) errors.add(k);
  EXPECT_EQ(errors.mean(), 50.5);
  EXPECT_EQ(errors.percentile(0.95), 95.0);
  EXPECT_EQ(errors.largest(), 100.0);
}

TEST(ErrorBound, FactorsAreThoseOfTheTablesOfChiSquare) {
  // 5 % quantiles of chi-square with 2, 10, 20 and 40 degrees of freedom: 0.10259, 3.9403, 10.851, 26.509.
  EXPECT_NEAR(exponential_bound_factor(1), 2.0 / 0.10259, 1e-3);
  EXPECT_NEAR(exponential_bound_factor(5), 10.0 / 3.9403, 1e-4);
  EXPECT_NEAR(exponential_bound_factor(10), 20.0 / 10.851, 1e-4);
  EXPECT_NEAR(exponential_bound_factor(20), 40.0 / 26.509, 1e-4);
  // The approximation beyond 500 meets the exact values.
  EXPECT_NEAR(exponential_bound_factor(501), exponential_bound_factor(500), 2e-4);
}

TEST(ErrorBound, WhatIsMeasuredIsKnownAndTheRestIsBounded) {
  const std::vector<double> sample{1.0, 3.0};
  EXPECT_DOUBLE_EQ(mean_at_most(sample, 2), 2.0);
  EXPECT_DOUBLE_EQ(mean_at_most(sample, 4), 0.5 * 2.0 + 0.5 * 2.0 * exponential_bound_factor(2));
  EXPECT_EQ(mean_at_most({}, 3), HUGE_VAL);
  EXPECT_EQ(mean_at_most({}, 0), 0.0);
}

// Six exponential errors of a large population of mean 1: in 5 % of the draws the bound is below that. 4000 draws leave a
// standard deviation of 0.34 %.
TEST(ErrorBound, CoversTheMeanAsOftenAsItSays) {
  std::mt19937 random(5);
  std::exponential_distribution<double> errors(1.0);
  int missed = 0;
  constexpr int kDraws = 4000;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<double> sample;
    for (int k = 0; k < 6; ++k) sample.push_back(errors(random));
    missed += mean_at_most(sample, 1000000) < 1.0 ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(missed) / kDraws, 0.05, 4 * 0.0034);
}

TEST(Leaders, FirstRunsSpanTheDirectionsThatOccur) {
  const auto strain = [](std::size_t point) {
    Vector7 e = Vector7::Zero();
    if (point < 10)
      e[k22] = -1e-3 * (1.0 - 0.01 * static_cast<double>(point));  // compressed, the largest first
    if (point == 10) e[k12] = e[k21] = 2e-4;                       // sheared
    if (point == 11) e[k22] = 3e-4;                                // the other way
    if (point == 12) e[kCurvature1] = 1e-9;                        // noise
    return e;
  };
  std::vector<std::size_t> points(13);
  std::iota(points.begin(), points.end(), std::size_t{0});
  EXPECT_EQ(span_directions<2>(points, strain, 1e-6), (std::vector<std::size_t>{0, 11, 10}));
  EXPECT_EQ(span_directions<2>({12}, strain, 1e-6), (std::vector<std::size_t>{12}));
}

}  // namespace
}  // namespace polargrain::coupler
