// SPDX-License-Identifier: GPL-2.0-or-later
// Tangents of cells that were asked for their stress alone, against what defines them.
#include "coupler/cells/secant_tangent.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "coupler/cells/linearised.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

template <typename Dimension>
class SecantTangentTest : public ::testing::Test {};

template <int number>
struct Dimension {
  static constexpr int value = number;
};
using Dimensions = ::testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(SecantTangentTest, Dimensions);

constexpr double kSecantLength = 0.01;

/// Some stress, and a tangent that is positive and not symmetric.
template <int dim>
Response<dim> some_start() {
  Response<dim> start;
  for (int i = 0; i < start.stress.size(); ++i) {
    start.stress(i) = -1e5 + 1e4 * i;
    for (int j = 0; j < start.stress.size(); ++j)
      start.tangent(i, j) = (i == j ? 5e7 : 0.0) + 1e6 * ((3 * i + 5 * j) % 7);
  }
  return start;
}

template <int dim>
Increment<dim> some_increment(Configuration configuration) {
  Increment<dim> increment;
  increment.configuration = configuration;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) increment.displacement_gradient(i, j) = 1e-3 * (i - 2 * j + 1);
  return increment;
}

/// The strain in the axes of the end.
template <int dim>
typename Cosserat<dim>::Vector strain_of(const Increment<dim>& increment) {
  if (increment.configuration == Configuration::fixed) return increment.strain();
  const fem::StretchAndTurn<dim> step = fem::stretch_and_turn(increment);
  return fem::rotated(typename Cosserat<dim>::Vector(step.stretch.strain()), step.turn);
}

TYPED_TEST(SecantTangentTest, LeadsToTheStressFound) {
  constexpr int dim = TypeParam::value;
  for (const Configuration configuration : {Configuration::fixed, Configuration::start}) {
    const Response<dim> start = some_start<dim>();
    const Increment<dim> increment = some_increment<dim>(configuration);
    const typename Cosserat<dim>::Vector strain = strain_of<dim>(increment);
    const typename Cosserat<dim>::Vector along_tangent = linearised_stress(start, increment);
    Response<dim> end;
    end.stress = along_tangent;
    for (int i = 0; i < end.stress.size(); ++i) end.stress(i) -= 300.0 * (i + 1);
    const auto before = with_tangent_turned(start, increment).tangent;
    const auto made = secant_tangent(start, end, increment, kSecantLength);
    const double scale = along_tangent.norm();
    EXPECT_LT(((made - before) * strain - (end.stress - along_tangent)).norm(), 1e-12 * scale);
    // No other direction is touched: strains at a right angle to it have the stress of before.
    typename Cosserat<dim>::Vector other = Cosserat<dim>::Vector::LinSpaced(-1.0, 2.0);
    other.template tail<Cosserat<dim>::couples>().setZero();
    typename Cosserat<dim>::Vector weighted = strain;
    weighted.template tail<Cosserat<dim>::couples>() *= kSecantLength * kSecantLength;
    other -= other.dot(weighted) / weighted.dot(strain) * strain;
    EXPECT_LT(((made - before) * other).norm(), 1e-12 * scale);
  }
}

TYPED_TEST(SecantTangentTest, KeepsTheTangentOfALinearCell) {
  constexpr int dim = TypeParam::value;
  const Response<dim> start = some_start<dim>();
  const Increment<dim> increment = some_increment<dim>(Configuration::fixed);
  Response<dim> end;
  end.stress = linearised_stress(start, increment);
  EXPECT_EQ(secant_tangent(start, end, increment, kSecantLength), start.tangent);
  EXPECT_EQ(secant_tangent(start, end, Increment<dim>{}, kSecantLength), start.tangent);
}

TYPED_TEST(SecantTangentTest, TakesNoJumpForStiffness) {
  constexpr int dim = TypeParam::value;
  const Response<dim> start = some_start<dim>();
  const Increment<dim> increment = some_increment<dim>(Configuration::fixed);
  const typename Cosserat<dim>::Vector strain = increment.strain();
  Response<dim> end;
  end.stress = linearised_stress(start, increment) - 3.0 * (start.tangent * strain);
  const double before = strain.dot(start.tangent * strain);
  EXPECT_NEAR(strain.dot(secant_tangent(start, end, increment, kSecantLength) * strain) / before, 0.1, 1e-12);
}

/// Answers with as many steps as it has been asked requests, so that one sees who answered.
CellCalls<2> counted(std::int64_t first, std::vector<std::size_t>& asked) {
  CellCalls<2> calls;
  calls.evaluate = [first, &asked](std::span<const PlaneRequest> requests,
                                   std::span<const std::size_t> points) {
    std::vector<PlaneReply> replies(requests.size());
    for (std::size_t k = 0; k < replies.size(); ++k) {
      replies[k].diagnostics.dem_steps = first + static_cast<std::int64_t>(points[k]);
      replies[k].response.tangent.setConstant(1.0);
      asked.push_back(points[k]);
    }
    return replies;
  };
  return calls;
}

TEST(SecantCalls, AskForTangentsWhereThereIsNoStart) {
  std::vector<std::size_t> with;
  std::vector<std::size_t> without;
  const CellCalls<2> calls = with_secant_tangents(counted(100, with), counted(200, without), kSecantLength);
  const Response<2> start = some_start<2>();
  const Increment<2> increment = some_increment<2>(Configuration::fixed);
  const std::vector<PlaneRequest> requests{
      {nullptr, increment, &start}, {nullptr, increment}, {nullptr, increment, &start}, {nullptr, increment}};
  const std::vector<std::size_t> points{4, 5, 6, 7};
  const std::vector<PlaneReply> replies = calls.evaluate(requests, points);
  EXPECT_EQ(with, (std::vector<std::size_t>{5, 7}));
  EXPECT_EQ(without, (std::vector<std::size_t>{4, 6}));
  ASSERT_EQ(replies.size(), 4u);
  const std::vector<std::int64_t> by{204, 105, 206, 107};
  for (std::size_t k = 0; k < replies.size(); ++k) {
    EXPECT_EQ(replies[k].diagnostics.dem_steps, by[k]);
    const bool is_secant = requests[k].start != nullptr;
    EXPECT_EQ(replies[k].response.tangent(0, 0) == 1.0, !is_secant);
  }
}

}  // namespace
}  // namespace polargrain::coupler
