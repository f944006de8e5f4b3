// SPDX-License-Identifier: GPL-2.0-or-later
// Iterations on levels against the direct solution of the same system.
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
#include "fem/solver/linear_solver.hpp"
#include "fem/solver/multilevel.hpp"
#include "fem/solver/tangent_matrix.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

/// A body on a rough plate.
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
  TangentMatrix<3> matrix(discretisation, constraints, problem.contributions);
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

/// Loads of varied size on every unknown.
Eigen::VectorXd varied_load(Eigen::Index unknowns) {
  Eigen::VectorXd load(unknowns);
  for (Eigen::Index i = 0; i < load.size(); ++i) load(i) = std::sin(1.7 * static_cast<double>(i * i % 101));
  return load;
}

struct Outcome {
  double error;  ///< of the solution, over its size
  int iterations;
  std::vector<int> levels;
};

/// @param direct_unknowns so few that small meshes have several levels
Outcome compare(const Problem<3>& problem, const ElasticParameters<3>& of,
                const std::function<bool(std::size_t)>& plastic, int direct_unknowns = 200) {
  const Eigen::SparseMatrix<double> matrix = tangent(problem, of, plastic);
  const CoarseSpace space = coarse_space<3>(problem.mesh, Constraints<3>(problem));
  const Eigen::VectorXd load = varied_load(matrix.rows());
  MultilevelSolver iterative(space, direct_unknowns);
  EXPECT_TRUE(iterative.factorise(matrix));
  const std::optional<Eigen::VectorXd> found = iterative.solve(load);
  if (!found) return {HUGE_VAL, iterative.iterations(), iterative.unknowns_of_levels()};
  DirectSolver direct;
  EXPECT_TRUE(direct.factorise(matrix));
  const Eigen::VectorXd expected = direct.solve(load);
  return {(*found - expected).norm() / expected.norm(), iterative.iterations(),
          iterative.unknowns_of_levels()};
}

const auto kElastic = [](std::size_t) { return false; };
const auto kMixed = [](std::size_t point) { return point % 3 != 0; };

// The residual is 1e-10 of the load; the condition of such bodies leaves the solution with some 1e-8.
constexpr double kClose = 1e-7;

/// Half of the iterations that are allowed: 75 to 105 on these small bodies.
constexpr int kFew = 120;

TEST(Multilevel, FindsTheDirectSolution) {
  for (const char* element : {"H20R", "H20", "H8", "T10", "W15"}) {
    const Problem<3> problem = body_on_plate(box({{0.2, 0.1, 0.3}, {4, 2, 6}}, element), sand());
    for (const auto& plastic : {std::function<bool(std::size_t)>(kElastic), {kMixed}}) {
      const Outcome outcome = compare(problem, sand(), plastic);
      EXPECT_LT(outcome.error, kClose) << element;
      EXPECT_LT(outcome.iterations, kFew) << element;
      // Corners, where the element has middle nodes, then aggregates.
      EXPECT_GE(outcome.levels.size(), std::string(element) == "H8" ? 2U : 3U) << element;
    }
  }
}

TEST(Multilevel, TakesCouplesFromWeakToStrong) {
  // The default needs few iterations; strong skew stiffness ties rotations of a node to displacements of its neighbours.
  for (const double length : {5e-3, 0.1})
    for (const double ratio : {0.02, 1.0, 3.0}) {
      ElasticParameters<3> of = sand();
      of.internal_length = length;
      of.cosserat_shear_modulus = ratio * 20e6;
      const Problem<3> problem = body_on_plate(box({{0.2, 0.1, 0.3}, {4, 2, 6}}), of);
      const Outcome outcome = compare(problem, of, kElastic);
      EXPECT_LT(outcome.error, 1e-6) << length << " " << ratio;
      EXPECT_LT(outcome.iterations, 200) << length << " " << ratio;
    }
}

TEST(Multilevel, TakesTiesAndNodesThatLackUnknowns) {
  Problem<3> problem = body_on_plate(box({{0.2, 0.1, 0.3}, {4, 2, 6}}), sand());
  problem.ties.push_back({"right", "left"});
  problem.prescribed.push_back({"front", Dof::u2, TimeTable::constant(0.0), {}});
  problem.prescribed.push_back({"front", Dof::w1, TimeTable::constant(0.0), {}});
  problem.prescribed.push_back({"back", Dof::u2, TimeTable::constant(0.0), {}});
  const Outcome outcome = compare(problem, sand(), kMixed);
  EXPECT_LT(outcome.error, kClose);
  EXPECT_LT(outcome.iterations, kFew);
}

TEST(Multilevel, TakesAContinuumWithoutRotations) {
  Problem<3> problem = body_on_plate(box({{0.2, 0.1, 0.3}, {4, 2, 6}}, "H20"), sand());
  problem.continuum = Continuum::cauchy;
  const Outcome outcome = compare(problem, sand(), kElastic);
  EXPECT_LT(outcome.error, kClose);
  EXPECT_LT(outcome.iterations, kFew);
}

// Coarser levels keep the count of iterations from growing with the mesh.
TEST(Multilevel, IterationsDoNotGrowWithTheMesh) {
  const auto iterations = [](int n) {
    return compare(body_on_plate(cylinder({0.05, 0.1, 2 * n, n, 3 * n}), sand()), sand(), kElastic)
        .iterations;
  };
  EXPECT_LE(iterations(2), iterations(1) + 15);
}

TEST(Multilevel, SaysThatASystemIsSingular) {
  const Problem<3> problem = body_on_plate(box({{1, 1, 1}, {2, 2, 2}}), sand());
  const Eigen::SparseMatrix<double> matrix = tangent(problem, sand(), kElastic);
  const CoarseSpace space = coarse_space<3>(problem.mesh, Constraints<3>(problem));
  MultilevelSolver solver(space, 200);
  EXPECT_FALSE(solver.factorise(0.0 * matrix));
}

// A shift by more than the lowest eigenvalues makes the matrix as indefinite as softening does.
TEST(LinearSolver, SolvesDirectlyWhatIterationsDoNot) {
  const Problem<3> problem = body_on_plate(box({{0.2, 0.1, 0.3}, {4, 2, 6}}), sand());
  Eigen::SparseMatrix<double> matrix = tangent(problem, sand(), kElastic);
  matrix.diagonal() *= 0.6;
  LinearSolver solver(coarse_space<3>(problem.mesh, Constraints<3>(problem)), 200);
  ASSERT_TRUE(solver.factorise(matrix));
  EXPECT_NE(solver.news().find("iterations on levels"), std::string::npos);
  const Eigen::VectorXd load = varied_load(matrix.rows());
  EXPECT_LT((matrix * solver.solve(load) - load).norm() / load.norm(), 1e-9);
  EXPECT_NE(solver.news().find("do not converge; direct"), std::string::npos);
  // The next matrix is solved directly at once, until a step begins.
  ASSERT_TRUE(solver.factorise(matrix));
  EXPECT_EQ(solver.news(), "");
  EXPECT_LT((matrix * solver.solve(load) - load).norm() / load.norm(), 1e-9);
  solver.begin_step();
  ASSERT_TRUE(solver.factorise(matrix));
  (void)solver.solve(load);
  EXPECT_NE(solver.news().find("do not converge; direct"), std::string::npos);
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
  Eigen::VectorXd corners(space.from_corners.cols());
  for (Eigen::Index row = 0; row < all.size(); ++row)
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(space.from_corners, row); entry;
         ++entry)
      if (entry.value() == 1.0) corners(entry.col()) = all(row);
  EXPECT_LT((space.from_corners * corners - all).norm(), 1e-14);
  EXPECT_EQ(space.groups.unknowns(), constraints.unknowns());
  // Nothing to gain from elements without middle nodes.
  const Problem<3> bricks = body_on_plate(box({{2, 3, 5}, {2, 1, 2}}, "H8"), sand());
  EXPECT_EQ(coarse_space<3>(bricks.mesh, Constraints<3>(bricks)).from_corners.cols(), 0);
}

// Motions of a body that nothing holds strain nothing: what aggregates are made of.
TEST(CoarseSpace, HoldsRigidMotionsWithoutStrain) {
  Problem<3> problem = body_on_plate(box({{2, 3, 5}, {2, 1, 2}}), sand());
  problem.prescribed.clear();
  const CoarseSpace space = coarse_space<3>(problem.mesh, Constraints<3>(problem));
  const Eigen::SparseMatrix<double> matrix = tangent(problem, sand(), kElastic);
  const Eigen::MatrixXd forces = matrix * space.groups.motions;
  EXPECT_LT(forces.cwiseAbs().maxCoeff() / matrix.coeffs().cwiseAbs().maxCoeff(), 1e-13);
}

}  // namespace
