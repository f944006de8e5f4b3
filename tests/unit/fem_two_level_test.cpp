// SPDX-License-Identifier: GPL-2.0-or-later
// Iterations on two levels against the direct solution of the same system.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

#include "fem/element/dofs.hpp"
#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/box.hpp"
#include "fem/mesh/cylinder.hpp"
#include "fem/solver/direct_solver.hpp"
#include "fem/solver/tangent_matrix.hpp"
#include "fem/solver/two_level.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

/// A body on a rough plate; in a box, two faces may be tied.
Problem<3> body_on_plate(Mesh<3> mesh, const ElasticParameters<3>& of) {
  Problem<3> problem;
  problem.mesh = std::move(mesh);
  problem.materials["all"] = std::make_shared<LocalMaterial<ElasticLaw<3>>>(ElasticLaw<3>(of));
  for (const Dof dof : node_dofs<3>())
    problem.prescribed.push_back({"bottom", dof, TimeTable::constant(0.0), {}});
  return problem;
}

ElasticParameters<3> sand() {
  ElasticParameters<3> of;
  of.young_modulus = 50e6;
  of.poisson_ratio = 0.25;
  of.cosserat_shear_modulus = 20e6;
  of.internal_length = 0.005;
  return of;
}

/// The tangent of a flow rule that is not associated, where `plastic` says so of a point: no symmetry, but stable.
Eigen::SparseMatrix<double> tangent(const Problem<3>& problem, const ElasticParameters<3>& of,
                                    const std::function<bool(std::size_t)>& plastic) {
  const Discretisation<3> discretisation(problem.mesh, Continuum::cosserat);
  const Constraints<3> constraints(problem);
  TangentMatrix<3> matrix(discretisation, constraints);
  const Matrix18 stiffness = elastic_stiffness(of);
  Vector18 normal = Vector18::Zero();
  normal.head<9>() << 1.4, 0.0, 0.2, 0.0, 1.4, 0.0, 0.2, 0.0, -1.6;
  Vector18 flow = Vector18::Zero();
  flow.head<9>() << 1.05, 0.0, 0.2, 0.0, 1.05, 0.0, 0.2, 0.0, -1.95;
  const Vector18 to = stiffness * flow;
  const Vector18 from = stiffness.transpose() * normal;
  const Matrix18 softened = stiffness - to * from.transpose() / (1.1 * normal.dot(to));
  std::vector<Response<3>> responses(discretisation.points());
  for (std::size_t point = 0; point < responses.size(); ++point)
    responses[point].tangent = plastic(point) ? softened : stiffness;
  return matrix.assemble({responses}, {});
}

/// Difference from the direct solution, over its size, with loads of varied size on every unknown; and the iterations.
std::pair<double, int> difference(const Problem<3>& problem, const ElasticParameters<3>& of,
                                  const std::function<bool(std::size_t)>& plastic) {
  const Eigen::SparseMatrix<double> matrix = tangent(problem, of, plastic);
  const CoarseSpace space = coarse_space<3>(problem.mesh, Constraints<3>(problem));
  EXPECT_LT(2 * space.prolongation.cols(), matrix.rows());
  Eigen::VectorXd load(matrix.rows());
  for (Eigen::Index i = 0; i < load.size(); ++i) load(i) = std::sin(1.7 * static_cast<double>(i * i % 101));
  TwoLevelSolver iterative(space);
  EXPECT_TRUE(iterative.factorise(matrix));
  const std::optional<Eigen::VectorXd> found = iterative.solve(load);
  if (!found) return {HUGE_VAL, iterative.iterations()};
  DirectSolver direct;
  EXPECT_TRUE(direct.factorise(matrix));
  const Eigen::VectorXd expected = direct.solve(load);
  return {(*found - expected).norm() / expected.norm(), iterative.iterations()};
}

const auto kElastic = [](std::size_t) { return false; };
const auto kMixed = [](std::size_t point) { return point % 3 != 0; };

// The residual is 1e-10 of the load; the condition of such bodies leaves the solution with some 1e-8.
constexpr double kClose = 1e-7;

TEST(TwoLevelSolver, FindsTheDirectSolution) {
  for (const char* element : {"H20R", "H20", "T10", "W15"}) {
    const Problem<3> problem = body_on_plate(box({{0.2, 0.1, 0.3}, {3, 2, 4}}, element), sand());
    for (const auto& plastic : {std::function<bool(std::size_t)>(kElastic), {kMixed}}) {
      const auto [error, iterations] = difference(problem, sand(), plastic);
      EXPECT_LT(error, kClose) << element;
      EXPECT_LT(iterations, 80) << element;
    }
  }
}

TEST(TwoLevelSolver, TakesTiesAndNodesThatLackUnknowns) {
  Problem<3> problem = body_on_plate(box({{0.2, 0.1, 0.3}, {3, 2, 4}}), sand());
  problem.ties.push_back({"right", "left"});
  problem.prescribed.push_back({"front", Dof::u2, TimeTable::constant(0.0), {}});
  problem.prescribed.push_back({"front", Dof::w1, TimeTable::constant(0.0), {}});
  problem.prescribed.push_back({"back", Dof::u2, TimeTable::constant(0.0), {}});
  const auto [error, iterations] = difference(problem, sand(), kMixed);
  EXPECT_LT(error, kClose);
  EXPECT_LT(iterations, 80);
}

// The coarse problem keeps the count of iterations from growing with the mesh.
TEST(TwoLevelSolver, IterationsDoNotGrowWithTheMesh) {
  const auto iterations = [](int n) {
    return difference(body_on_plate(cylinder({0.05, 0.1, 2 * n, n, 3 * n}), sand()), sand(), kElastic).second;
  };
  EXPECT_LE(iterations(2), iterations(1) + 10);
}

TEST(TwoLevelSolver, SaysThatASystemIsSingular) {
  const Problem<3> problem = body_on_plate(box({{1, 1, 1}, {2, 2, 2}}), sand());
  const Eigen::SparseMatrix<double> matrix = tangent(problem, sand(), kElastic);
  const CoarseSpace space = coarse_space<3>(problem.mesh, Constraints<3>(problem));
  TwoLevelSolver solver(space);
  EXPECT_FALSE(solver.factorise(0.0 * matrix));
}

TEST(CoarseSpace, HoldsFieldsThatAreLinearAlongEdges) {
  const Problem<3> problem = body_on_plate(box({{2, 3, 5}, {2, 1, 2}}), sand());
  const Constraints<3> constraints(problem);
  const CoarseSpace space = coarse_space<3>(problem.mesh, constraints);
  // u1 = x3, which is zero on the plate: of the corners, then of all.
  const auto field = [&](const auto& of) {
    Eigen::VectorXd nodal =
        Eigen::VectorXd::Zero(entry_of<3>(static_cast<Eigen::Index>(problem.mesh.nodes.size())));
    for (std::size_t node = 0; node < problem.mesh.nodes.size(); ++node)
      nodal(static_cast<Eigen::Index>(entry_of<3>(node, Dof::u1))) = of(problem.mesh.nodes[node]);
    return constraints.restrict_to_free(nodal);
  };
  const Eigen::VectorXd all = field([](const Eigen::Vector3d& x) { return x(2); });
  Eigen::VectorXd corners(space.prolongation.cols());
  for (Eigen::Index column = 0; column < corners.size(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(space.prolongation, column); entry; ++entry)
      if (entry.value() == 1.0) corners(column) = all(entry.row());
  EXPECT_LT((space.prolongation * corners - all).norm(), 1e-14);
  EXPECT_EQ(space.node_begins.back(), constraints.unknowns());
  // Nothing to gain from elements without middle nodes.
  const Problem<3> bricks = body_on_plate(box({{2, 3, 5}, {2, 1, 2}}, "H8"), sand());
  EXPECT_EQ(coarse_space<3>(bricks.mesh, Constraints<3>(bricks)).prolongation.cols(), 0);
}

}  // namespace
