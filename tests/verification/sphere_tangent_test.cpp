// SPDX-License-Identifier: GPL-2.0-or-later
// Tangents of cells of spheres against central differences of the cells themselves, and the fast elimination against a
// dense solution of the same equations.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cstdio>

#include "dem/cell/averages.hpp"
#include "dem/cell/cell_service.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/spheres/space_contact.hpp"
#include "dem/spheres/space_tangents.hpp"
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
  // What Newton asks for: the derivative with respect to the increment, at an increment that goes on.
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
  // Contacts that come to slide or stop sliding within the difference make the rest.
  EXPECT_LT(condensed, 0.25);
  EXPECT_LT(condensed, 0.3 * voigt);
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
  CondensedSpaceTangent condensed;
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

}  // namespace
}  // namespace polargrain::dem
