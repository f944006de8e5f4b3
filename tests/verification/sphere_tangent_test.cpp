// SPDX-License-Identifier: GPL-2.0-or-later
// Tangents of cells of spheres against central differences of the cells themselves, and the fast elimination against a
// dense solution of the same equations.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "dem/cell/averages.hpp"
#include "dem/cell/cell_service.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/cell/space_tangents.hpp"
#include "tests/support/sheared_spheres.hpp"
#include "tests/support/sphere_cells.hpp"

namespace polargrain::dem {
namespace {

constexpr int kPairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

/// d sigma over the six symmetric strains, by central differences about an increment.
Eigen::Matrix<double, 9, 6> differences(CellOfGrains& cell, const StatePointer& start,
                                        const Eigen::Matrix3d& increment, double strain) {
  Eigen::Matrix<double, 9, 6> columns;
  for (int k = 0; k < 6; ++k) {
    const auto [i, j] = kPairs[k];
    Eigen::Matrix3d change = Eigen::Matrix3d::Zero();
    change(i, j) += 0.5 * strain;
    change(j, i) += 0.5 * strain;
    CellRequest request{start, {}};
    request.increment.displacement_gradient = increment + change;
    const CellReply ahead = cell.evaluate(request);
    request.increment.displacement_gradient = increment - change;
    const CellReply back = cell.evaluate(request);
    EXPECT_EQ(ahead.response.quality, Quality::good) << ahead.response.message;
    EXPECT_EQ(back.response.quality, Quality::good) << back.response.message;
    columns.col(k) = (ahead.response.components() - back.response.components()).head<9>() / (2.0 * strain);
  }
  return columns;
}

/// The same of a tangent.
Eigen::Matrix<double, 9, 6> columns_of(const Matrix18& tangent) {
  Eigen::Matrix<double, 9, 6> columns;
  for (int k = 0; k < 6; ++k) {
    const auto [i, j] = kPairs[k];
    columns.col(k) = 0.5 * (tangent.col(3 * i + j) + tangent.col(3 * j + i)).head<9>();
  }
  return columns;
}

TEST(SphereTangent, IsTheDerivativeOfTheStressAtRest) {
  // Hertz's force grows with the power 3/2 of the overlap: its slope is not force over overlap.
  CellDefinition definition = test::hertz_spheres();
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = 1e-6;
  const auto cell = make_cell_service(definition);
  const CellReply rest = cell->initial();
  const Eigen::Matrix<double, 9, 6> expected = differences(*cell, rest.state, Eigen::Matrix3d::Zero(), 1e-7);
  const Eigen::Matrix<double, 9, 6> found = columns_of(rest.response.tangent);
  definition.control.tangent = CellTangent::voigt;
  const Eigen::Matrix<double, 9, 6> affine =
      columns_of(make_cell_service(definition)->initial().response.tangent);
  const double condensed = (found - expected).norm() / expected.norm();
  const double voigt = (affine - expected).norm() / expected.norm();
  std::printf(
      "[figure] 500 spheres of Hertz's contacts at rest: condensed tangent %.4f of the derivative away, "
      "Voigt tangent %.2f\n",
      condensed, voigt);
  // The spring that holds grains without contacts, and contacts that open within the difference.
  EXPECT_LT(condensed, 0.02);
  EXPECT_LT(condensed, 0.3 * voigt);
}

TEST(SphereTangent, KnowsContactsThatSlide) {
  CellDefinition definition = test::linear_spheres();
  definition.control.inertial_number = 1.2e-3;
  definition.control.least_steps = 100;
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = 5e-4;
  const auto cell = make_cell_service(definition);
  CellRequest request;
  request.increment.displacement_gradient.diagonal() << 5e-4, 5e-4, -1e-3;
  request.state = cell->evaluate(request).state;
  const CellReply reply = cell->evaluate(request);
  // As Newton's method needs it: the derivative with respect to the increment, at an increment that goes on.
  const Eigen::Matrix3d further = 0.1 * request.increment.displacement_gradient;
  const Eigen::Matrix<double, 9, 6> expected = differences(*cell, reply.state, further, 1e-5);
  CellRequest on{reply.state, {}};
  on.increment.displacement_gradient = further;
  const CellReply ahead = cell->evaluate(on);
  const double condensed = (columns_of(ahead.response.tangent) - expected).norm() / expected.norm();
  definition.control.tangent = CellTangent::voigt;
  const Matrix18 affine = make_cell_service(definition)->evaluate(on).response.tangent;
  const double voigt = (columns_of(affine) - expected).norm() / expected.norm();
  std::printf(
      "[figure] 1,000 spheres at a strain of 2e-3, %.0f %% of the contacts sliding: condensed tangent %.2f of "
      "the derivative away, Voigt tangent %.2f\n",
      100.0 * ahead.diagnostics.sliding_fraction, condensed, voigt);
  // Contacts that come to slide or stop sliding within the difference make the rest. Without knowing the slip: 0.18.
  EXPECT_LT(condensed, 0.12);
}

TEST(SphereTangent, StaysNearTheDerivativeWhereTheNetworkIsNearlySingular) {
  CellDefinition definition = test::linear_spheres();
  definition.control.inertial_number = 1e-3;
  const auto cell = make_cell_service(definition);
  CellRequest request;
  request.increment.displacement_gradient.diagonal() << 5e-4, 5e-4, -1e-3;
  double worst = 0.0;
  for (int increment = 1; increment <= 6; ++increment) {
    const CellReply reply = cell->evaluate(request);
    if (increment % 2 == 0) {
      const Eigen::Matrix<double, 9, 6> expected =
          differences(*cell, request.state, request.increment.displacement_gradient, 2e-4);
      const double off = (columns_of(reply.response.tangent) - expected).norm() / expected.norm();
      worst = std::max(worst, off);
    }
    request.state = reply.state;
  }
  std::printf(
      "[figure] 1,000 spheres at strains of 2e-3, 4e-3 and 6e-3 by increments of 1e-3: condensed tangent at most "
      "%.2f of the derivative away\n",
      worst);
  // The rest comes to slide or stops sliding within the difference, and the spring that holds the grains. With one of 1e-4
  // of the mean normal stiffness the first of the three is away by 2.7 and the last by 0.6.
  EXPECT_LT(worst, 0.12);
}

/// d (stress, couple stress) over all eighteen components of the Cosserat strain, by central differences about an
/// increment: a displacement gradient d u_j / d x_i at a given micro-rotation is the strain eps_ij.
Matrix18 cosserat_differences(CellOfGrains& cell, const CellRequest& about, double strain, double curvature) {
  Matrix18 columns;
  for (int k = 0; k < 18; ++k) {
    const int i = k % 9 / 3;
    const int j = k % 3;
    const auto moved = [&](double sign) {
      CellRequest request = about;
      if (k < 9)
        request.increment.displacement_gradient(j, i) += sign * strain;
      else
        request.increment.curvature(j, i) += sign * curvature;
      const CellReply reply = cell.evaluate(request);
      EXPECT_EQ(reply.response.quality, Quality::good) << reply.response.message;
      return reply.response.components();
    };
    columns.col(k) = (moved(1.0) - moved(-1.0)) / (2.0 * (k < 9 ? strain : curvature));
  }
  return columns;
}

/// How far a tangent is from the differences, over their norm: forces over strains, couples over curvatures, and the
/// two mixed blocks, over the mean of the others. `d` makes one unit of all.
struct Away {
  double forces, couples, mixed;
};
Away away(const Matrix18& tangent, const Matrix18& differences, double d) {
  Vector18 scale = Vector18::Ones();
  scale.tail<9>().setConstant(1.0 / d);
  const Matrix18 from = scale.asDiagonal() * differences * scale.asDiagonal();
  const Matrix18 off = scale.asDiagonal() * tangent * scale.asDiagonal() - from;
  const double couples = from.bottomRightCorner<9, 9>().norm();
  const double forces = from.topLeftCorner<9, 9>().norm();
  return {off.topLeftCorner<9, 9>().norm() / forces, off.bottomRightCorner<9, 9>().norm() / couples,
          std::hypot(off.topRightCorner<9, 9>().norm(), off.bottomLeftCorner<9, 9>().norm()) /
              std::sqrt(forces * couples)};
}

CellDefinition controlled_spheres() {
  CellDefinition definition = test::rolling_spheres(test::hertz_spheres(), 1.0, 0.2);
  definition.control.rotations = CellRotations::controlled;
  return definition;
}

TEST(SphereTangent, OfControlledRotationsIsTheDerivativeOfTheWholeStressAtRest) {
  CellDefinition definition = controlled_spheres();
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = 1e-6;
  definition.control.damping = 0.3;
  const auto cell = make_cell_service(definition);
  const CellReply rest = cell->initial();
  const double d = 2.0 * definition.packing.mean_radius();
  const Matrix18 expected = cosserat_differences(*cell, {rest.state, {}}, 1e-7, 1e-7 / d);
  definition.control.tangent = CellTangent::voigt;
  const Away condensed = away(rest.response.tangent, expected, d);
  const Away voigt = away(make_cell_service(definition)->initial().response.tangent, expected, d);
  std::printf(
      "[figure] 500 spheres at rest, controlled rotations: condensed tangent %.4f of the derivative away in the "
      "forces, %.4f in the couples, %.4f mixed; Voigt tangent %.2f, %.2f, %.2f\n",
      condensed.forces, condensed.couples, condensed.mixed, voigt.forces, voigt.couples, voigt.mixed);
  // The spring that holds grains without contacts, and contacts that open within the difference.
  EXPECT_LT(condensed.forces, 0.02);
  EXPECT_LT(condensed.couples, 0.02);
  EXPECT_LT(condensed.mixed, 0.02);
}

class SlidingAndRolling : public ::testing::TestWithParam<double> {};

TEST_P(SlidingAndRolling, OfControlledRotationsIsKnownByTheIncrement) {
  CellDefinition definition = controlled_spheres();
  definition.control.inertial_number = 1.2e-3;
  definition.control.least_steps = 100;
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = 5e-4;
  const auto cell = make_cell_service(definition);
  const double d = 2.0 * definition.packing.mean_radius();
  CellRequest request;
  request.increment.displacement_gradient.diagonal() << 5e-4, 5e-4, -1e-3;
  request.increment.rotation << 2e-4, -1e-4, 3e-4;
  request.increment.curvature << 1e-2, -2e-2, 0.0, 1e-2, 2e-2, -1e-2, 0.0, 1e-2, -3e-2;
  request.state = cell->evaluate(request).state;
  request.state = cell->evaluate(request).state;
  const double part = GetParam();
  request.increment.displacement_gradient *= part;
  request.increment.rotation *= part;
  request.increment.curvature *= part;
  const CellReply ahead = cell->evaluate(request);
  const Matrix18 expected = cosserat_differences(*cell, request, 1e-5, 1e-5 / d);
  definition.control.tangent = CellTangent::voigt;
  const Away condensed = away(ahead.response.tangent, expected, d);
  const Away voigt = away(make_cell_service(definition)->evaluate(request).response.tangent, expected, d);
  std::printf(
      "[figure] 500 spheres at a strain of 2e-3, controlled rotations, by an increment of %.0e, %.0f %% of the contacts "
      "sliding and %.0f %% at the rolling limit: condensed tangent %.2f of the derivative away in the forces, %.2f in "
      "the couples, %.2f mixed; Voigt tangent %.2f, %.2f, %.2f\n",
      1e-3 * part, 100.0 * ahead.diagnostics.sliding_fraction, 100.0 * ahead.diagnostics.rolling_fraction,
      condensed.forces, condensed.couples, condensed.mixed, voigt.forces, voigt.couples, voigt.mixed);
  // The rest comes to slide or stops sliding within the difference. A tangent of the contacts as they stand at the
  // end is away by 0.33 and 0.29 by the small increment.
  EXPECT_LT(condensed.forces, 0.1);
  EXPECT_LT(condensed.couples, 0.1);
}
INSTANTIATE_TEST_SUITE_P(ByIncrement, SlidingAndRolling, ::testing::Values(0.1, 1.0));

/// A spring with a limit of 1 that is carried along a way of straight pieces, in small steps.
Eigen::Vector2d carried(const std::vector<Eigen::Vector2d>& pieces, const Eigen::Vector2d& start) {
  constexpr int kSteps = 20000;
  Eigen::Vector2d spring = start;
  for (const Eigen::Vector2d& piece : pieces)
    for (int step = 0; step < kSteps; ++step) {
      spring += piece / kSteps;
      if (const double size = spring.norm(); size > 1.0) spring /= size;
    }
  return spring;
}

TEST(SlippedSpring, AnswersAsOneThatIsCarriedAlong) {
  constexpr double kChange = 1e-4;
  const Eigen::Vector2d at_limit(1.0, 0.0);
  double off = 0.0;
  for (const double slip : {0.1, 1.0, 5.0}) {
    const auto answer = [&](const Eigen::Vector2d& change) {
      const Eigen::Vector2d ahead(slip + change.x(), change.y());
      return Eigen::Vector2d((carried({ahead}, at_limit) - carried({Eigen::Vector2d(slip, 0.0)}, at_limit)) /
                             kChange);
    };
    off = std::max(off, std::abs(answer({0.0, kChange}).y() - spring_left_across(slip, 1.0)));
    off = std::max(off, std::abs(answer({kChange, 0.0}).x() - spring_left_along(slip, 0.0)));
    // It slides, then it is carried back by 0.3: of a change in proportion to the way, the last part counts.
    constexpr double kBack = 0.3;
    const double last = kBack / (slip + kBack);
    const Eigen::Vector2d there(slip + (1.0 - last) * kChange, 0.0);
    const Eigen::Vector2d back(-kBack + last * kChange, 0.0);
    const double along = (carried({there, back}, at_limit) -
                          carried({Eigen::Vector2d(slip, 0.0), Eigen::Vector2d(-kBack, 0.0)}, at_limit))
                             .x() /
                         kChange;
    off = std::max(off, std::abs(along - spring_left_along(slip, kBack)));
  }
  std::printf(
      "[figure] what is left of a spring that has slid: %.0e from one that is carried along in steps\n", off);
  // Steps of at most 5 / 20,000 of its limit, and a change that is not infinitely small.
  EXPECT_LT(off, 5e-4);
  EXPECT_EQ(spring_left_along(0.0, 0.0), 1.0);
  EXPECT_EQ(spring_left_across(0.0, 1.0), 1.0);
}

/// The equations of a network written down whole, with Lagrange multipliers for the mean rotation.
Matrix18 dense_cosserat_tangent(const SpaceNetwork& network, std::span<const double> weights) {
  const double spring = network.hold * mean_normal_stiffness(network.contacts);
  const double arm = network.contacts.front().arm_first;
  const Eigen::Index unknowns = 6 * static_cast<Eigen::Index>(network.grains);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(unknowns + 3, unknowns + 3);
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(unknowns + 3, 18);
  for (Eigen::Index k = 0; k < unknowns; ++k)
    matrix(k, k) =
        k % 6 < 3 ? spring : spring * arm * arm;  // rotations count as arc lengths of the first arm
  for (int grain = 0; grain < network.grains; ++grain)
    for (int axis = 0; axis < 3; ++axis)
      matrix(6 * grain + 3 + axis, unknowns + axis) = matrix(unknowns + axis, 6 * grain + 3 + axis) =
          weights[static_cast<std::size_t>(grain)];
  std::vector<LinearSpaceContact> laws;
  for (const Contact& contact : network.contacts) {
    const LinearSpaceContact& law = laws.emplace_back(contact, network.frame);
    const Eigen::Matrix<double, 12, 12> stiffness = law.motions.transpose() * law.stiffness * law.motions;
    const Eigen::Matrix<double, 12, 18> load = law.motions.transpose() * law.stiffness * law.affine;
    const int place[2] = {6 * contact.first, 6 * contact.second};
    for (int row = 0; row < 12; ++row) {
      loads.row(place[row / 6] + row % 6) -= load.row(row);
      for (int column = 0; column < 12; ++column)
        matrix(place[row / 6] + row % 6, place[column / 6] + column % 6) += stiffness(row, column);
    }
  }
  const Eigen::MatrixXd motions = matrix.partialPivLu().solve(loads);
  Matrix18 stresses = Matrix18::Zero();
  for (std::size_t c = 0; c < laws.size(); ++c) {
    Eigen::Matrix<double, 12, 18> motion;
    motion << motions.middleRows<6>(6 * network.contacts[c].first),
        motions.middleRows<6>(6 * network.contacts[c].second);
    stresses += laws[c].affine.transpose() * laws[c].stiffness * (laws[c].motions * motion + laws[c].affine);
  }
  return stresses / network.volume;
}

TEST(SphereTangent, IsTheDenseSolutionOfItsEquations) {
  // Sliding, rolling and torsion: li_chu in full.
  CellDefinition definition = test::linear_spheres();
  const std::string stock = "pair_style      gran model hooke/radii tangential history";
  definition.script.replace(
      definition.script.find(stock), stock.size(),
      "fix fr all property/global coefficientRollingFriction peratomtypepair 1 0.1\n"
      "fix kr all property/global rollingStiffnessRatio peratomtypepair 1 1.0\n"
      "pair_style gran model hooke/radii tangential li_chu rolling_friction li_chu torsionTorque on");
  // The first 150 spheres of the thousand would not touch all around; a cell of its own is made small enough instead.
  definition.control.inertial_number = 2e-3;
  definition.control.tangent = CellTangent::none;
  const auto cell = make_cell_service(definition);
  CellRequest request;
  request.increment.displacement_gradient.diagonal() << 5e-4, 5e-4, -1e-3;
  const CellReply reply = cell->evaluate(request);
  ASSERT_GT(reply.diagnostics.sliding_fraction, 0.0);
  ASSERT_GT(reply.diagnostics.rolling_fraction, 0.0);
  constexpr int kGrains = 200;  // those of the thousand with lower numbers, and the contacts among them
  std::vector<Contact> contacts;
  for (const Contact& contact : cell->contacts())
    if (contact.first < kGrains && contact.second < kGrains) contacts.push_back(contact);
  ASSERT_GT(contacts.size(), 20u);
  const SpaceNetwork network{contacts, kGrains, Eigen::Matrix3d::Identity(), definition.packing.volume(),
                             1e-2};
  const std::vector<double> weights(kGrains, 1.0 / kGrains);
  CondensedSpaceTangent condensed(best_instruction_set(), EliminationDigits::whole);
  const auto fast = condensed.cosserat(network, weights);
  ASSERT_TRUE(fast);
  const Matrix18 plain = dense_cosserat_tangent(network, weights);
  const double forces = (*fast - plain).topLeftCorner<9, 9>().norm() / plain.topLeftCorner<9, 9>().norm();
  const double couples =
      (*fast - plain).bottomRightCorner<9, 9>().norm() / plain.bottomRightCorner<9, 9>().norm();
  std::printf("[figure] %zu contacts among %d spheres: forces %.1e, couples %.1e from the dense solution\n",
              contacts.size(), kGrains, forces, couples);
  EXPECT_LT(forces, 1e-9);
  EXPECT_LT(couples, 1e-9);
}

/// The network of a thousand spheres at 0.6 % of compression at constant volume, most contacts of which have slipped.
const test::LoadedNetwork& sheared_network() {
  static const test::LoadedNetwork made = [] {
    CellDefinition definition = test::linear_spheres();
    definition.control.inertial_number = 1e-3;
    const Eigen::Matrix3d gradient = Eigen::Vector3d(5e-4, 5e-4, -1e-3).asDiagonal();
    return test::loaded_networks(definition, gradient, 6, 6).back();
  }();
  return made;
}

constexpr double kHoldOfCells = 3e-3;  // cell_tangents.cpp

TEST(SphereTangent, SinglePrecisionHasTheDigitsOfATangent) {
  const SpaceNetwork network = sheared_network().network(kHoldOfCells);
  CondensedSpaceTangent whole(best_instruction_set(), EliminationDigits::whole);
  CondensedSpaceTangent single;
  const auto distance = [](const Matrix18& one, const Matrix18& other) {
    return (one - other).norm() / other.norm();
  };
  const double free = distance(single.classical(network).value(), whole.classical(network).value());
  const double held = distance(single.cosserat(network, sheared_network().weights).value(),
                               whole.cosserat(network, sheared_network().weights).value());
  std::printf(
      "[figure] sheared spheres: single precision is %.1e off with free rotations, %.1e with controlled ones\n",
      free, held);
  EXPECT_EQ(single.repeated(), 0);
  // A thousandth is asked of a tangent, and differences of the cell scatter by more. Ten such states gave 1e-7 to 1e-5.
  EXPECT_LT(free, 1e-4);
  EXPECT_LT(held, 1e-4);
}

TEST(SphereTangent, SinglePrecisionGivesTheSameBitsWithEveryInstructionSet) {
  const SpaceNetwork network = sheared_network().network(kHoldOfCells);
  const Matrix18 expected = CondensedSpaceTangent(InstructionSet::baseline).classical(network).value();
  for (const auto set : {InstructionSet::avx2, InstructionSet::avx512})
    if (is_supported(set)) {
      EXPECT_EQ(CondensedSpaceTangent(set).classical(network).value(), expected);
    }
}

TEST(SphereTangent, DoublePrecisionIsTakenWhereSingleDoesNotBalance) {
  // Rattlers that nearly nothing holds: single precision cannot tell their motions.
  CondensedSpaceTangent whole(best_instruction_set(), EliminationDigits::whole);
  // Forces that do not balance, and pivots that vanish.
  for (const double hold : {1e-5, 1e-9}) {
    CondensedSpaceTangent single;
    const SpaceNetwork network = sheared_network().network(hold);
    const auto found = single.classical(network);
    EXPECT_EQ(single.repeated(), 1);
    EXPECT_EQ(found, whole.classical(network));
  }
}

}  // namespace
}  // namespace polargrain::dem
