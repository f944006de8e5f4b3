// SPDX-License-Identifier: GPL-2.0-or-later
// The condensed tangent of a cell against finite differences of the cell itself (docs/theory/grains.md, C.7),
// on 400 discs with rolling resistance and prescribed mean rotation.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <vector>

#include "dem/cell/condensed_tangent.hpp"
#include "dem/cell/plain_tangents.hpp"
#include "tests/support/cell_fixture.hpp"
#include "tests/support/plane_cells.hpp"

namespace polargrain::dem {
namespace {

constexpr std::array<Component, 6> kColumns{k11, k22, k12, k21, kCurvature1, kCurvature2};

CellDefinition strict_cell(CellRotations rotations) {
  CellDefinition definition = test::rolling_cell(1.0, 0.4);
  definition.control.rotations = rotations;
  definition.control.inertial_number = 2.4e-5;
  definition.control.unbalanced_force_ratio = 1e-6;
  definition.control.unbalanced_moment_ratio = 1e-6;
  definition.control.damping = 0.5;
  definition.control.least_steps = 400;
  return definition;
}

/// Curvatures and couple stresses are taken per mean diameter, so that all columns are of one kind.
constexpr double kDiameter = 0.02;

Vector7 factors() {
  Vector7 factors = Vector7::Ones();
  factors.tail<2>().setConstant(kDiameter);
  return factors;
}

/// The increment whose Cosserat strain is `strain` (eps_33 = 0), without rotation of the grains.
Increment<2> increment_of(const Vector7& scaled) {
  const Vector7 strain = scaled.cwiseQuotient(factors());
  Increment<2> increment;
  increment.displacement_gradient << strain[k11], strain[k21], strain[k12], strain[k22];
  increment.curvature << strain[kCurvature1], strain[kCurvature2];
  return increment;
}

PlaneReply evaluate(const PlaneCell& cell, const StatePointer& state, const Vector7& strain) {
  PlaneRequest request;
  request.state = state;
  request.increment = increment_of(strain);
  const PlaneReply reply = cell.evaluate(request);
  EXPECT_EQ(reply.response.quality, Quality::good) << reply.response.message;
  return reply;
}

/// Central differences of the stress at the end of an increment with respect to that increment.
Matrix7 differences(const PlaneCell& cell, const StatePointer& state, const Vector7& increment, double step) {
  Matrix7 derivative = Matrix7::Zero();
  for (const Component column : kColumns) {
    const Vector7 change = step * Vector7::Unit(column);
    const Vector7 difference = evaluate(cell, state, increment + change).response.stress -
                               evaluate(cell, state, increment - change).response.stress;
    derivative.col(column) = difference.cwiseQuotient(factors()) / (2.0 * step);
  }
  return derivative;
}

Matrix7 scaled(const Matrix7& tangent) {
  return factors().cwiseInverse().asDiagonal() * tangent * factors().cwiseInverse().asDiagonal();
}

double largest_error(const Matrix7& tangent, const Matrix7& derivative) {
  double largest = 0.0;
  for (const Component column : kColumns)
    largest = std::max(largest,
                       (tangent.col(column) - derivative.col(column)).norm() / derivative.col(column).norm());
  return largest;
}

TEST(Tangent, IsTheDerivativeOfTheCellBeforeYield) {
  const auto cell = make_plane_cell(strict_cell(CellRotations::controlled));
  const PlaneReply start = cell->initial();
  const Matrix7 derivative = differences(*cell, start.state, Vector7::Zero(), 1e-7);
  const double error = largest_error(scaled(start.response.tangent), derivative);
  std::printf(
      "[figure] condensed tangent of the packing at rest: columns %.4f of the derivative away at most\n",
      error);
  // Asked for. What is left is the prestress: contacts turn with the strain, and their forces with them (p
  // over the modulus, 1e5 / 3e7).
  EXPECT_LT(error, 0.02);
}

TEST(Tangent, AfterYieldItKnowsWhatSlides) {
  CellDefinition definition = strict_cell(CellRotations::controlled);
  definition.control.inertial_number = 1.2e-3;
  definition.control.least_steps = 100;
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = 5e-4;
  const auto condensed_cell = make_plane_cell(definition);
  definition.control.tangent = CellTangent::voigt;
  const auto affine_cell = make_plane_cell(definition);
  Vector7 step = Vector7::Zero();
  step(k11) = 1e-3;
  step(k22) = -1e-3;
  StatePointer state;
  for (int k = 1; k <= 10; ++k) {
    const PlaneReply reply = evaluate(*condensed_cell, state, step);
    state = reply.state;
    if (k != 1 && k != 3 && k != 10) continue;
    // As Newton's method needs it: the derivative with respect to the increment, at increments that go on, short and long.
    for (const double length : {0.1, 1.0, 3.0}) {
      const Vector7 further = length * step;
      const Matrix7 derivative = differences(*condensed_cell, state, further, 0.1 * length * 1e-3);
      const auto error = [&](const PlaneCell& cell) {
        return (scaled(evaluate(cell, state, further).response.tangent) - derivative).norm() /
               derivative.norm();
      };
      const double condensed = error(*condensed_cell);
      const double affine = error(*affine_cell);
      std::printf(
          "[figure] after %d e-3 of isochoric strain, %.0f %% of the contacts sliding, %.0f %% at the rolling "
          "limit, an increment of %.0e: condensed tangent %.2f of the derivative away, Voigt tangent %.2f\n",
          k, 100.0 * reply.diagnostics.sliding_fraction, 100.0 * reply.diagnostics.rolling_fraction,
          length * 1e-3, condensed, affine);
      // Grains that rearrange within the difference make the rest. Without regard to the contacts that come to their limit
      // on the way it is 0.2 to 0.3 at the long increments.
      EXPECT_LT(condensed, 0.2);
      EXPECT_LT(condensed, 0.3 * affine);
    }
  }
}

TEST(Tangent, KnowsTheStockRollingModel) {
  // epsd2 is li_chu with a stiffness ratio of 1: the same grains, so the same tangent.
  const CellDefinition ours = test::rolling_cell(1.0, 0.4);
  CellDefinition stock = ours;
  const std::string name = "rolling_friction li_chu";
  stock.script.replace(stock.script.find(name), name.size(), "rolling_friction epsd2");
  Vector7 step = Vector7::Zero();
  step(k11) = 1e-3;
  step(k22) = -1e-3;
  const PlaneReply one = evaluate(*make_plane_cell(ours), nullptr, step);
  const PlaneReply other = evaluate(*make_plane_cell(stock), nullptr, step);
  const double stress = (one.response.stress - other.response.stress).norm() / one.response.stress.norm();
  const double tangent = (one.response.tangent - other.response.tangent).norm() / one.response.tangent.norm();
  std::printf("[figure] epsd2 against li_chu with the same parameters: stress %.1e, tangent %.1e apart\n",
              stress, tangent);
  EXPECT_LT(stress, 1e-4);
  EXPECT_LT(tangent, 1e-3);
  EXPECT_EQ(one.diagnostics.rolling_fraction, other.diagnostics.rolling_fraction);
}

TEST(Tangent, IsThePlainOneAlongAPath) {
  CellDefinition definition = test::rolling_cell(1.0, 0.4);
  definition.control.rotations = CellRotations::controlled;
  const auto cell = make_plane_cell(definition);
  const int grains = static_cast<int>(definition.packing.grains.size());
  const std::vector<double> weights(grains, 1.0 / grains);
  Vector7 step = Vector7::Zero();
  step(k11) = 1e-3;
  step(k22) = -1e-3;
  StatePointer state;
  CondensedTangent condensed;
  double largest = 0.0;
  PlaneReply reply;
  for (int k = 1; k <= 20; ++k) {
    reply = evaluate(*cell, state, step);
    state = reply.state;
    const ContactNetwork network{cell->contacts(), grains, Eigen::Matrix2d::Identity(),
                                 definition.packing.volume(), 1e-4};
    const auto difference = [&largest](const std::optional<Matrix7>& fast,
                                       const std::optional<Matrix7>& plain) {
      ASSERT_TRUE(fast && plain);
      largest = std::max(largest, (scaled(*fast) - scaled(*plain)).norm() / scaled(*plain).norm());
    };
    difference(condensed.classical(network), plain_classical_tangent(network));
    difference(condensed.cosserat(network, weights), plain_cosserat_tangent(network, weights));
  }
  std::printf(
      "[figure] 20 increments of 1e-3, at last %.0f %% sliding, %.0f %% at the rolling limit, %.0f rattlers: "
      "condensed tangent at most %.1e from the plain one, %d of 40 taken the plain way\n",
      100.0 * reply.diagnostics.sliding_fraction, 100.0 * reply.diagnostics.rolling_fraction,
      100.0 * reply.diagnostics.rattlers, largest, condensed.fallbacks());
  EXPECT_LT(largest, 1e-10);
  EXPECT_EQ(condensed.fallbacks(), 0);
}

TEST(Tangent, OutlivesABoxThatComesApartAndCloses) {
  // On the way contacts exist while no grain has two of them, so none has a weight in the mean rotation.
  CellDefinition definition = test::rolling_cell(1.0, 0.4);
  definition.control.rotations = CellRotations::controlled;
  definition.control.most_relaxation_steps = 100;
  const auto cell = make_plane_cell(definition);
  PlaneRequest request;
  for (const double strain :
       {2e-3, 2e-3, 5e-3, -2e-3, -2e-3, -1e-3, -1e-3, -1e-3, -1e-3, -1e-3, -1e-3, -2e-3}) {
    request.increment.displacement_gradient = strain * Eigen::Matrix2d::Identity();
    const PlaneReply reply = cell->evaluate(request);
    EXPECT_TRUE(reply.response.tangent.allFinite());
    request.state = reply.state;
    std::printf("[figure] volume strain %.0e more: %lld contacts\n", 2.0 * strain,
                static_cast<long long>(reply.diagnostics.contacts));
  }
}

}  // namespace
}  // namespace polargrain::dem
