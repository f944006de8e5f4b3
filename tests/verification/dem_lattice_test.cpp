// SPDX-License-Identifier: GPL-2.0-or-later
// A cell that is a hexagonal lattice of equal discs has known moduli (docs/theory/grains.md, E.7 a): per unit
// thickness lambda = (sqrt3/4)(kn - ks), G = (sqrt3/4)(kn + ks), Gc = (sqrt3/2) ks, couple modulus B = sqrt3
// kth, at any number of discs.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/support/lattice_fixture.hpp"
#include "tests/support/plane_cells.hpp"

namespace polargrain::dem {
namespace {

using test::kNormal;
using test::kRolling;
using test::kTangential;
using test::kThickness;
using test::lattice;

/// Stress increment of one evaluation from the packing at rest.
Vector7 stress_increment(const PlaneCell& cell, const Increment<2>& increment) {
  PlaneRequest request;
  request.increment = increment;
  const PlaneReply reply = cell.evaluate(request);
  EXPECT_EQ(reply.response.quality, Quality::good) << reply.response.message;
  // Moments in balance (C.4): the multiplier carries the skew stress.
  EXPECT_NEAR(reply.diagnostics.multiplier, reply.response.stress(k21) - reply.response.stress(k12),
              1e-5 * std::abs(reply.response.stress(k11)));
  return reply.response.stress - cell.initial().response.stress;
}

// The overlap shortens branches and lever arms, and prestress adds its own geometric stiffness: each by about
// the overlap.
constexpr double kTolerance = 1e-3;
constexpr double kStrain = 1e-5;
const double kLambda = std::sqrt(3.0) / 4.0 * (kNormal - kTangential) / kThickness;
const double kShear = std::sqrt(3.0) / 4.0 * (kNormal + kTangential) / kThickness;
const double kCouple = std::sqrt(3.0) * kRolling / kThickness;
const double kCosserat = std::sqrt(3.0) / 2.0 * kTangential / kThickness;

class Lattice : public ::testing::TestWithParam<int> {};

TEST_P(Lattice, FreeRotationsGiveTheClassicalModuli) {
  const auto cell = make_plane_cell(lattice(GetParam(), GetParam(), CellRotations::free));
  Increment<2> increment;
  increment.displacement_gradient << kStrain, 0.0, 0.0, 0.0;
  const Vector7 axial = stress_increment(*cell, increment);
  EXPECT_NEAR(axial(k11) / kStrain, kLambda + 2.0 * kShear, kTolerance * kShear);
  EXPECT_NEAR(axial(k22) / kStrain, kLambda, kTolerance * kShear);
  increment.displacement_gradient << 0.0, kStrain, 0.0, 0.0;
  const Vector7 shear = stress_increment(*cell, increment);
  EXPECT_NEAR(shear(k12) / kStrain, kShear, kTolerance * kShear);
  EXPECT_NEAR(shear(k21) / kStrain, kShear, kTolerance * kShear);
  std::printf("[figure] lattice of %d x %d, free rotations: G %.5f of the exact\n", GetParam(), GetParam(),
              shear(k21) / kStrain / kShear);
}

TEST_P(Lattice, ThePackingTellsItsCosseratModuliWithFreeRotationsToo) {
  CellDefinition definition = lattice(GetParam(), GetParam(), CellRotations::free);
  definition.control.tangent = CellTangent::cosserat;
  const Matrix7 tangent = make_plane_cell(definition)->initial().response.tangent;
  EXPECT_NEAR(tangent(k12, k12), kShear + kCosserat, kTolerance * kShear);
  EXPECT_NEAR(tangent(k12, k21), kShear - kCosserat, kTolerance * kShear);
  EXPECT_NEAR(tangent(kCurvature1, kCurvature1), kCouple, kTolerance * kCouple);
  EXPECT_NEAR(tangent(kCurvature2, kCurvature2), kCouple, kTolerance * kCouple);
}

TEST_P(Lattice, BlockedRotationGivesTheCosseratModulusAtAnySize) {
  const auto cell = make_plane_cell(lattice(GetParam(), GetParam(), CellRotations::controlled));
  Increment<2> increment;
  increment.displacement_gradient << 0.0, kStrain, 0.0,
      0.0;  // micro-rotation zero: eps21 = strain, eps12 = 0
  const Vector7 stress = stress_increment(*cell, increment);
  EXPECT_NEAR(stress(k21) / kStrain, kShear + kCosserat, kTolerance * kShear);
  EXPECT_NEAR(stress(k12) / kStrain, kShear - kCosserat, kTolerance * kShear);
  // And a rotation of the grains alone: eps21 = w, eps12 = -w.
  Increment<2> turn;
  turn.micro_rotation = kStrain;
  const Vector7 turned = stress_increment(*cell, turn);
  PlaneRequest request;
  request.increment = turn;
  const CellDiagnostics diagnostics = cell->evaluate(request).diagnostics;
  EXPECT_NEAR(diagnostics.mean_rotation, kStrain, 1e-12);
  EXPECT_LT(diagnostics.rotation_spread, 1e-3 * kStrain);
  EXPECT_NEAR(diagnostics.fabric[0], 0.5, 1e-4);
  EXPECT_NEAR(diagnostics.fabric[1], 0.5, 1e-4);
  EXPECT_EQ(diagnostics.rattlers, 0.0);
  EXPECT_EQ(diagnostics.coordination_number, 6.0);
  EXPECT_NEAR(turned(k21) / kStrain, 2.0 * kCosserat, kTolerance * kShear);
  EXPECT_NEAR(turned(k12) / kStrain, -2.0 * kCosserat, kTolerance * kShear);
  std::printf("[figure] lattice of %d x %d, blocked rotation: G + Gc %.5f, Gc %.5f of the exact\n",
              GetParam(), GetParam(), stress(k21) / kStrain / (kShear + kCosserat),
              turned(k21) / kStrain / (2.0 * kCosserat));
}

TEST_P(Lattice, CurvatureGivesTheCoupleModulusAtAnySize) {
  const auto cell = make_plane_cell(lattice(GetParam(), GetParam(), CellRotations::controlled));
  Increment<2> bend;
  bend.curvature << 1e-3, 0.0;  // 1e-5 rad a diameter
  const Vector7 along = stress_increment(*cell, bend);
  EXPECT_NEAR(along(kCurvature1) / 1e-3, kCouple, kTolerance * kCouple);
  EXPECT_NEAR(along(kCurvature2) / 1e-3, 0.0, kTolerance * kCouple);
  // Nothing but couple stress: the sliding law does not see the curvature.
  EXPECT_LT(along.head<5>().norm() / 1e-5, kTolerance * kShear);
  bend.curvature << 0.0, 1e-3;
  const Vector7 across = stress_increment(*cell, bend);
  EXPECT_NEAR(across(kCurvature2) / 1e-3, kCouple, kTolerance * kCouple);
  std::printf("[figure] lattice of %d x %d, curvature: couple modulus %.5f and %.5f of the exact\n",
              GetParam(), GetParam(), along(kCurvature1) / 1e-3 / kCouple,
              across(kCurvature2) / 1e-3 / kCouple);
}

TEST_P(Lattice, CurvatureTurnsWithTheBox) {
  // The engine's frame is turned by 0.3 rad against the laboratory, and a large rotation turns it further
  // while the curvature acts: the couple stress must turn with the grains.
  CellDefinition definition = lattice(GetParam(), GetParam(), CellRotations::controlled);
  const auto turn = [](double angle) {
    Eigen::Matrix2d matrix;
    matrix << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    return matrix;
  };
  definition.packing.box = turn(0.3) * definition.packing.box;
  for (Grain& grain : definition.packing.grains) grain.position = turn(0.3) * grain.position;
  const auto cell = make_plane_cell(definition);
  Increment<2> bend;
  bend.micro_rotation = 0.2;
  bend.displacement_gradient = turn(0.2) - Eigen::Matrix2d::Identity();
  bend.curvature << 1e-3, 0.0;  // per position before the turn
  const Vector7 stress = stress_increment(*cell, bend);
  const Eigen::Vector2d expected = turn(0.2) * Eigen::Vector2d(kCouple * 1e-3, 0.0);
  EXPECT_NEAR(stress(kCurvature1), expected(0), 1e-3 * kTolerance * kCouple);
  EXPECT_NEAR(stress(kCurvature2), expected(1), 1e-3 * kTolerance * kCouple);
}

TEST_P(Lattice, CondensedTangentsAreThoseModuli) {
  const auto free = make_plane_cell(lattice(GetParam(), GetParam(), CellRotations::free));
  const Matrix7 classical = free->initial().response.tangent;
  EXPECT_NEAR(classical(k12, k12), kShear, kTolerance * kShear);
  EXPECT_NEAR(classical(k11, k11), kLambda + 2.0 * kShear, kTolerance * kShear);
  const auto held = make_plane_cell(lattice(GetParam(), GetParam(), CellRotations::controlled));
  const Matrix7 cosserat = held->initial().response.tangent;
  EXPECT_NEAR(cosserat(k21, k21), kShear + kCosserat, kTolerance * kShear);
  EXPECT_NEAR(cosserat(k12, k21), kShear - kCosserat, kTolerance * kShear);
  EXPECT_NEAR(cosserat(kCurvature1, kCurvature1), kCouple, kTolerance * kCouple);
  EXPECT_NEAR(cosserat(kCurvature2, kCurvature2), kCouple, kTolerance * kCouple);
  EXPECT_NEAR(cosserat(kCurvature1, kCurvature2), 0.0, kTolerance * kCouple);
}

TEST(LatticeFlip, ChangesNothing) {
  // The lattice of 4 x 4 in a box whose tilt is just below half its length: the first increment carries it
  // past, the state after it is in the flipped box.
  CellDefinition definition = lattice(4, 4, CellRotations::controlled);
  Eigen::Matrix2d& box = definition.packing.box;
  box(0, 1) = 0.5 * box(0, 0);
  const auto cell = make_plane_cell(definition);
  PlaneRequest request;
  request.increment.displacement_gradient << 0.0, kStrain, 0.0, 0.0;
  const Vector7 start = cell->initial().response.stress;
  for (int step = 1; step <= 2; ++step) {
    const PlaneReply reply = cell->evaluate(request);
    ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
    const Vector7 stress = reply.response.stress - start;
    std::printf("[figure] lattice, increment %d about a flip: G + Gc %.5f of the exact\n", step,
                stress(k21) / (step * kStrain) / (kShear + kCosserat));
    EXPECT_NEAR(stress(k21) / (step * kStrain), kShear + kCosserat, kTolerance * kShear);
    EXPECT_NEAR(stress(k12) / (step * kStrain), kShear - kCosserat, kTolerance * kShear);
    request.state = reply.state;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Lattice, ::testing::Values(4, 8, 12));

}  // namespace
}  // namespace polargrain::dem
