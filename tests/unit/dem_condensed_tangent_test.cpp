// SPDX-License-Identifier: GPL-2.0-or-later
// The condensed tangent by fronts against the plain one (docs/theory/grains.md, C.7), on packings and on
// networks as bad as they come; the same bits with every instruction set and whatever was solved before.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "dem/cell/condensed_tangent.hpp"
#include "dem/cell/plain_tangents.hpp"
#include "dem/cell/tangents.hpp"
#include "tests/support/contact_networks.hpp"

namespace polargrain::dem {
namespace {

using test::contact_of;
using test::Mobilisation;

constexpr double kHold = 1e-4;

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets;
  for (const auto set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512})
    if (is_supported(set)) sets.push_back(set);
  return sets;
}

ContactNetwork network_of(const std::vector<Contact>& contacts, int grains, double hold = kHold) {
  Eigen::Matrix2d frame;
  frame << 0.96, -0.28, 0.28, 0.96;
  return {contacts, grains, frame, 0.004, hold};
}

std::vector<double> equal_weights(int grains) {
  return std::vector<double>(grains, 1.0 / grains);
}

double distance(const Matrix7& one, const Matrix7& other) {
  // Couple moduli are smaller than the others by the square of the grain size (0.01 m).
  Vector7 units = Vector7::Ones();
  units.tail<2>().setConstant(100.0);
  const Matrix7 scaled = units.asDiagonal() * other * units.asDiagonal();
  return (units.asDiagonal() * one * units.asDiagonal() - scaled).norm() / scaled.norm();
}

/// Both tangents agree with the plain ones. @returns how many came from the plain way themselves
int expect_plain(const ContactNetwork& network, std::span<const double> weights, double tolerance = 1e-10) {
  CondensedTangent tangent;
  const auto classical = tangent.classical(network);
  const auto plain_classical = plain_classical_tangent(network);
  EXPECT_EQ(classical.has_value(), plain_classical.has_value());
  if (classical && plain_classical) {
    EXPECT_LT(distance(*classical, *plain_classical), tolerance);
  }
  const auto cosserat = tangent.cosserat(network, weights);
  const auto plain_cosserat = plain_cosserat_tangent(network, weights);
  EXPECT_EQ(cosserat.has_value(), plain_cosserat.has_value());
  if (cosserat && plain_cosserat) {
    EXPECT_LT(distance(*cosserat, *plain_cosserat), tolerance);
  }
  return tangent.fallbacks();
}

// The kernels -----------------------------------------------------------------------------------------------

struct Front {
  int pivots, rows, sides;
  [[nodiscard]] int stride() const { return rows + sides + kRowSlackOf<float> + 3; }
};

template <typename Number = double>
std::vector<Number> random_front(const Front& front) {
  std::mt19937 random(1);
  std::vector<Number> values(static_cast<std::size_t>(front.rows) * front.stride(), Number(0));
  for (int row = 0; row < front.rows; ++row)
    for (int column = 0; column < front.rows + front.sides; ++column)
      values[row * front.stride() + column] = static_cast<Number>(static_cast<double>(random()) / 1e9 - 2.0);
  return values;
}

const std::vector<Front> kFronts{{1, 1, 1},   {3, 3, 3},   {3, 15, 7},  {7, 8, 7},   {8, 8, 3},    {9, 30, 3},
                                 {12, 20, 7}, {16, 17, 1}, {24, 24, 7}, {45, 93, 7}, {120, 120, 3}};

template <typename Number>
class DenseKernels : public ::testing::Test {};
using Numbers = ::testing::Types<double, float>;
TYPED_TEST_SUITE(DenseKernels, Numbers);

TYPED_TEST(DenseKernels, GiveTheSameBitsWithEveryInstructionSet) {
  for (const Front& front : kFronts) {
    std::vector<TypeParam> expected;
    constexpr int kKnown = kRowSlackOf<TypeParam>;
    std::vector<TypeParam> known((front.rows - front.pivots + 1) * kKnown, TypeParam(0.25));
    for (const InstructionSet set : instruction_sets()) {
      std::vector<TypeParam> values = random_front<TypeParam>(front);
      const FrontMatrixOf<TypeParam> matrix{values.data(), front.rows, front.rows + front.sides,
                                            front.stride(), front.pivots};
      ASSERT_TRUE(eliminate(matrix, set));
      substitute_back(matrix, static_cast<const TypeParam*>(known.data()), kKnown, set);
      // The slack of a row may be used, but nothing before the next row's begin is part of the matrix.
      for (int row = 0; row < front.rows; ++row)
        for (int k = front.rows + front.sides; k < front.stride(); ++k) values[row * front.stride() + k] = 0;
      if (expected.empty()) expected = values;
      EXPECT_EQ(values, expected) << front.pivots << " of " << front.rows;
    }
  }
  EXPECT_TRUE(is_supported(best_instruction_set()));
}

TEST(DenseElimination, SolvesTheEquations) {
  for (const Front& front : kFronts) {
    std::vector<double> values = random_front(front);
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Matrix all = Eigen::Map<Matrix, 0, Eigen::OuterStride<>>(
        values.data(), front.rows, front.rows + front.sides, Eigen::OuterStride<>(front.stride()));
    const int border = front.rows - front.pivots;
    Matrix known = Matrix::Zero(border + 1, 8);
    known.topLeftCorner(border, front.sides).setConstant(0.5);
    const Matrix exact = all.topLeftCorner(front.pivots, front.pivots)
                             .partialPivLu()
                             .solve(all.topRightCorner(front.pivots, front.sides) -
                                    all.block(0, front.pivots, front.pivots, border) *
                                        known.topLeftCorner(border, front.sides));
    const FrontMatrix matrix{values.data(), front.rows, front.rows + front.sides, front.stride(),
                             front.pivots};
    ASSERT_TRUE(eliminate(matrix, best_instruction_set()));
    substitute_back(matrix, known.data(), 8, best_instruction_set());
    const Matrix solved = Eigen::Map<Matrix, 0, Eigen::OuterStride<>>(
        values.data() + front.rows, front.pivots, front.sides, Eigen::OuterStride<>(front.stride()));
    EXPECT_LT((solved - exact).norm(), 1e-9 * exact.norm());
  }
}

TEST(DenseElimination, RefusesSingularPivots) {
  std::vector<double> values(4 * 16, 0.0);
  EXPECT_FALSE(eliminate(FrontMatrix{values.data(), 4, 5, 16, 4}, best_instruction_set()));
  values[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(eliminate(FrontMatrix{values.data(), 4, 5, 16, 4}, best_instruction_set()));
}

// The plan --------------------------------------------------------------------------------------------------

TEST(EliminationPlan, EliminatesEveryGrainAndTakesEveryContactOnce) {
  const Packing packing = read_packing("cases/biaxial/packing400.csv");
  const std::vector<Contact> contacts = test::contacts_of(packing, {});
  EliminationPlan plan;
  plan.make(contacts, 400);
  std::vector<int> seen(400, 0);
  for (const int grain : plan.order()) ++seen[grain];
  EXPECT_EQ(seen, std::vector<int>(400, 1));
  std::vector<int> taken(contacts.size(), 0);
  int pivots = 0;
  int unclaimed = 0;  // fronts whose parent has not come yet
  for (const EliminationPlan::Front& front : plan.fronts()) {
    std::vector<bool> inside(400, false);
    for (const int grain : plan.order().subspan(front.pivots_begin, front.pivots)) inside[grain] = true;
    for (const int grain : plan.borders().subspan(front.border_begin, front.border)) inside[grain] = true;
    for (const int c : plan.contacts().subspan(front.contacts_begin, front.contacts)) {
      ++taken[c];
      EXPECT_TRUE(inside[contacts[c].first] && inside[contacts[c].second]);
    }
    EXPECT_EQ(front.pivots_begin, pivots);
    pivots += front.pivots;
    unclaimed += (front.border > 0 ? 1 : 0) - front.children;
  }
  EXPECT_EQ(taken, std::vector<int>(contacts.size(), 1));
  EXPECT_EQ(pivots, 400);
  EXPECT_EQ(unclaimed, 0);
}

// The tangents ----------------------------------------------------------------------------------------------

TEST(CondensedTangent, IsThePlainOneOnPackings) {
  const Packing packing = read_packing("cases/biaxial/packing400.csv");
  for (const double limit : {0.0, 0.1, 0.3, 0.6})
    for (const unsigned seed : {1u, 2u, 3u}) {
      const auto contacts = test::contacts_of(packing, {limit, limit, seed});
      EXPECT_EQ(expect_plain(network_of(contacts, 400), equal_weights(400)), 0) << limit << " seed " << seed;
    }
  const auto all_sliding = test::contacts_of(packing, {1.0, 1.0, 1});
  expect_plain(network_of(all_sliding, 400), equal_weights(400));
  const auto contacts = test::contacts_of(test::tiled(packing, 2), {0.1, 0.1, 1});
  EXPECT_EQ(expect_plain(network_of(contacts, 1600), equal_weights(1600)), 0);
}

TEST(CondensedTangent, HasTheSameBitsWithEveryInstructionSetAndWhateverCameBefore) {
  const Packing packing = read_packing("cases/biaxial/packing400.csv");
  const auto contacts = test::contacts_of(packing, {0.2, 0.2, 1});
  const auto other = test::contacts_of(test::tiled(packing, 2), {0.0, 0.0, 2});
  const ContactNetwork network = network_of(contacts, 400);
  const auto weights = equal_weights(400);
  CondensedTangent baseline(InstructionSet::baseline);
  const Matrix7 classical = baseline.classical(network).value();
  const Matrix7 cosserat = baseline.cosserat(network, weights).value();
  for (const InstructionSet set : instruction_sets()) {
    CondensedTangent tangent(set);
    EXPECT_EQ(tangent.cosserat(network, weights).value(), cosserat);
    EXPECT_TRUE(tangent.cosserat(network_of(other, 1600), equal_weights(1600)));
    EXPECT_TRUE(tangent.classical(network_of({contacts.begin(), contacts.begin() + 7}, 400)));
    EXPECT_EQ(tangent.classical(network).value(), classical);
    EXPECT_EQ(tangent.cosserat(network, weights).value(), cosserat);
  }
}

TEST(CondensedTangent, IsThePlainOneOnBadNetworks) {
  // Any grain may touch any other, itself through an image, or the same one several times; many touch none.
  constexpr double kRadius = 0.01;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    const int grains = 1 + static_cast<int>(random() % 40);
    const int count = 1 + static_cast<int>(random() % (2 * grains));
    std::vector<Contact> contacts;
    for (int c = 0; c < count; ++c) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(random()) / 4294967295.0;
      const Eigen::Vector2d branch = 1.999 * kRadius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      const int first = static_cast<int>(random() % grains);
      const int second = static_cast<int>(random() % grains);
      contacts.push_back(contact_of(first, second, branch, kRadius, kRadius, {0.1, 0.2, seed}, random));
    }
    SCOPED_TRACE(seed);
    std::vector<double> weights(grains);
    double sum = 0.0;
    for (double& weight : weights) sum += weight = static_cast<double>(random() % 4);
    for (double& weight : weights) weight = sum > 0.0 ? weight / sum : 1.0 / grains;
    // Sliding contacts and the springs of grains that nothing else holds may nearly cancel; digits are lost
    // then.
    expect_plain(network_of(contacts, grains), weights);
  }
}

TEST(CondensedTangent, WithoutWeightsTheMeanRotationIsFree) {
  // Two grains with one contact, as when a box has come apart and closes again: no grain has two contacts, so
  // none has a weight.
  std::mt19937 random(1);
  const Eigen::Vector2d branch(0.0199, 0.0);
  for (const int grains : {2, 5}) {
    const std::vector<Contact> contacts{contact_of(0, grains - 1, branch, 0.01, 0.01, {}, random)};
    const ContactNetwork network = network_of(contacts, grains);
    EXPECT_EQ(expect_plain(network, {}), 0);
    // Nothing carries: what is left is the springs' share.
    const Matrix7 tangent = CondensedTangent().cosserat(network, {}).value();
    EXPECT_LT(tangent.norm(), 1e-3 * voigt_cosserat_tangent(contacts, network.frame, network.volume).norm());
  }
  EXPECT_EQ(CondensedTangent().cosserat(network_of({}, 4), {}).value(), Matrix7::Zero());
  EXPECT_EQ(CondensedTangent().classical(network_of({}, 0)).value(), Matrix7::Zero());
}

TEST(CondensedTangent, IsEmptyWhereThereIsNoSolution) {
  // Without springs a grain without contacts has no equation.
  std::mt19937 random(1);
  std::vector<Contact> contacts{contact_of(0, 1, {0.0199, 0.0}, 0.01, 0.01, {}, random)};
  CondensedTangent tangent;
  EXPECT_FALSE(tangent.classical(network_of(contacts, 3, 0.0)));
  EXPECT_EQ(tangent.fallbacks(), 1);
  // No torque holds the mean rotation: the multiplier is 0 / 0, which the balance of forces shows.
  EXPECT_FALSE(tangent.cosserat(network_of(contacts, 2), std::vector<double>(2, 0.0)));
  EXPECT_EQ(tangent.fallbacks(), 2);
  contacts[0].normal_stiffness = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(tangent.classical(network_of(contacts, 3)));
  EXPECT_FALSE(tangent.cosserat(network_of(contacts, 3), equal_weights(3)));
}

TEST(CondensedTangent, IsThePlainOneOnIndefiniteNetworks) {
  // Springs that push: pivots come close to zero, and digits are lost on the way.
  const Packing packing = read_packing("cases/biaxial/packing400.csv");
  int fallbacks = 0;
  for (const double hold : {-0.1, -0.3, -1.0, -2.0}) {
    const auto contacts = test::contacts_of(packing, {0.3, 0.3, 1});
    fallbacks += expect_plain(network_of(contacts, 400, hold), equal_weights(400), 1e-8);
  }
  std::printf("[figure] indefinite networks: %d of 8 tangents taken the plain way\n", fallbacks);
}

}  // namespace
}  // namespace polargrain::dem
