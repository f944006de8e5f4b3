// SPDX-License-Identifier: GPL-2.0-or-later
// A point of `informed` that goes by its cell's answer (coupler/cells/own_answer.hpp).
#include "coupler/cells/own_answer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace polargrain::coupler {
namespace {

constexpr double kLength = 3e-3;
constexpr double kWorkOff = 4e-3;

OwnAnswerRules<2> rules(bool controlled) {
  return {{13e6, 10e6, kLength}, controlled, kLength, kWorkOff};
}

/// Any stress of the size of a pressure, not symmetric, with couple stresses.
Vector7 stress_of_law() {
  Vector7 stress;
  stress << -110e3, -240e3, -150e3, 31e3, 25e3, 40.0, -15.0;
  return stress;
}

/// A cell that answers linearly, with a tangent that is not symmetric.
Matrix7 stiffness() {
  Matrix7 matrix;
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 7; ++j) {
      const double couples = (i > 4 ? kLength : 1.0) * (j > 4 ? kLength : 1.0);
      matrix(i, j) = couples * ((i == j ? 40e6 : 5e6) + 1e6 * i - 2e5 * j * i);
    }
  return matrix;
}
Response<2> cell_after(const Increment<2>& increment, bool controlled) {
  Response<2> cell;
  cell.stress << -100e3, -180e3, -120e3, 20e3, 20e3, 0.0, 0.0;
  if (controlled) cell.stress.tail<2>() << 25.0, 10.0;
  cell.stress += stiffness() * (controlled ? increment.strain() : symmetric_part<2>(increment.strain()));
  cell.tangent = stiffness();
  return cell;
}

PlaneReply reply(const Response<2>& cell) {
  PlaneReply reply;
  reply.response = cell;
  return reply;
}

Increment<2> increment_of(const Vector7& strain) {
  // Without micro-rotation: eps_12 = d u2 / d x1 (Increment::strain).
  Increment<2> increment;
  increment.displacement_gradient << strain(k11), strain(k21), strain(k12), strain(k22);
  increment.curvature = strain.tail<2>();
  return increment;
}

Increment<2> some_increment(double size) {
  Vector7 strain;
  strain << 0.6 * size, -size, 0.0, 0.3 * size, 0.5 * size, 0.4 * size / kLength, -0.2 * size / kLength;
  return increment_of(strain);
}

TEST(OwnAnswer, BeginsInBalanceAndEndsAtTheCell) {
  for (const bool controlled : {false, true}) {
    const OwnAnswerRules<2> by = rules(controlled);
    const Response<2> before = cell_after(Increment<2>{}, controlled);
    const OwnAnswer<2> start = left_law(by, stress_of_law(), reply(before));
    OwnAnswer<2> end;
    const Response<2> nothing = own_answer(by, start, Increment<2>{}, reply(before), end);
    EXPECT_LT((nothing.stress - stress_of_law()).norm(), 1e-9) << controlled;
    EXPECT_EQ(end.strained, 0.0);

    const Increment<2> increment = some_increment(2.0 * kWorkOff);
    const Response<2> cell = cell_after(increment, controlled);
    const Response<2> there = own_answer(by, start, increment, reply(cell), end);
    if (controlled) {
      EXPECT_EQ(there.stress, cell.stress);
      EXPECT_EQ(there.tangent, cell.tangent);
    } else {
      EXPECT_LT((symmetric_part<2>(there.stress) - symmetric_part<2>(cell.stress)).norm(), 1e-9);
      // Skew and couple stress are the case's, and go on from those of the law (A.4).
      const Vector7 strain = increment.strain();
      EXPECT_NEAR(there.stress(k21) - there.stress(k12),
                  25e3 - 31e3 + 2.0 * 10e6 * (strain(k21) - strain(k12)), 1e-6);
      EXPECT_NEAR(there.stress(kCurvature1), 40.0 + 2.0 * 13e6 * kLength * kLength * increment.curvature(0),
                  1e-9);
    }
    EXPECT_EQ(end.carried, Vector7(Vector7::Zero()));
  }
}

TEST(OwnAnswer, StepsOfAnySizeLetGoOfTheSame) {
  // A strain in one direction, in one step or in five: the same share is left.
  const OwnAnswerRules<2> by = rules(false);
  const OwnAnswer<2> start = left_law(by, stress_of_law(), reply(cell_after(Increment<2>{}, false)));
  const Increment<2> whole = some_increment(0.5 * kWorkOff);
  OwnAnswer<2> at_once;
  const Vector7 expected = own_answer(by, start, whole, reply(cell_after(whole, false)), at_once).stress;
  OwnAnswer<2> point = start;
  Vector7 stress;
  for (int part = 1; part <= 5; ++part) {
    OwnAnswer<2> next;
    const Increment<2> so_far = some_increment(0.1 * part * kWorkOff);
    stress =
        own_answer(by, point, some_increment(0.1 * kWorkOff), reply(cell_after(so_far, false)), next).stress;
    point = next;
  }
  EXPECT_LT((stress - expected).norm(), 1e-8 * expected.norm());
  EXPECT_GT((expected - cell_after(whole, false).stress).norm(), 1e3)
      << "nothing is left, the test shows nothing";
}

TEST(OwnAnswer, TheTangentSeesWhatIsWorkedOff) {
  for (const bool controlled : {false, true}) {
    const OwnAnswerRules<2> by = rules(controlled);
    const OwnAnswer<2> start = left_law(by, stress_of_law(), reply(cell_after(Increment<2>{}, controlled)));
    const Vector7 strain = some_increment(0.3 * kWorkOff).strain();
    const auto answer = [&](const Vector7& at) {
      OwnAnswer<2> end;
      const Increment<2> increment = increment_of(at);
      return own_answer(by, start, increment, reply(cell_after(increment, controlled)), end);
    };
    const Matrix7 tangent = answer(strain).tangent;
    for (int j = 0; j < 7; ++j) {
      if (j == k33) continue;  // plane strain
      const double step = 1e-7 / (j > 4 ? kLength : 1.0);
      Vector7 plus = strain, minus = strain;
      plus(j) += step;
      minus(j) -= step;
      const Vector7 slope = (answer(plus).stress - answer(minus).stress) / (2.0 * step);
      // Quadratic in the step over the strain: 1e-4 squared.
      EXPECT_LT((slope - tangent.col(j)).norm(), 1e-6 * stiffness().col(j).norm()) << j << ' ' << controlled;
    }
  }
}

TEST(OwnAnswer, WhatIsCarriedTurnsWithTheMaterial) {
  const OwnAnswerRules<2> by = rules(false);
  Response<2> cell = cell_after(Increment<2>{}, false);
  const OwnAnswer<2> start = left_law(by, stress_of_law(), reply(cell));
  Increment<2> turn;  // by a quarter: R - I
  turn.displacement_gradient << -1.0, -1.0, 1.0, -1.0;
  turn.micro_rotation = 0.5 * M_PI;
  turn.configuration = Configuration::start;
  std::swap(cell.stress(k11), cell.stress(k22));
  cell.stress(k12) = cell.stress(k21) = -cell.stress(k12);
  OwnAnswer<2> end;
  const Vector7 turned = own_answer(by, start, turn, reply(cell), end).stress;
  EXPECT_NEAR(turned(k11), stress_of_law()(k22), 1e-6);
  EXPECT_NEAR(turned(k22), stress_of_law()(k11), 1e-6);
  EXPECT_NEAR(turned(k12), -stress_of_law()(k21), 1e-6);
}

}  // namespace
}  // namespace polargrain::coupler
