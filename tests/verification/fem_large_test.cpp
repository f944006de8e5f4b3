// SPDX-License-Identifier: GPL-2.0-or-later
// Large displacements and rotations (updated Lagrangian) against closed forms.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <iostream>

#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/loads.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

const TimeTable kZeroOfLarge = TimeTable::constant(0.0);

Problem<2> elastic_block(const RectangleSpecification& size, const ElasticParameters<2>& parameters) {
  Problem<2> problem;
  problem.mesh = rectangle(size);
  problem.deformation = Deformation::large;
  problem.materials["all"] = std::make_shared<LocalMaterial<ElasticLaw<2>>>(ElasticLaw<2>(parameters));
  return problem;
}

TEST(large_deformation, stress_turns_with_the_material) {
  LocalMaterial<ElasticLaw<2>> material(ElasticLaw<2>({1e6, 0.3, 1e5, 0.01, Vector7{10, 20, 5, 3, 4, 1, 2}}));
  material.allocate(1);
  Increment<2> increment;  // rigid rotation by 90 degrees: R - I
  increment.displacement_gradient << -1.0, -1.0, 1.0, -1.0;
  increment.micro_rotation = 0.5 * M_PI;
  increment.configuration = Configuration::start;
  std::vector<Response<2>> responses(1);
  material.evaluate(std::vector<Increment<2>>{increment}, responses);
  // s'_ij = R s R^T with R e_1 = e_2, R e_2 = -e_1.
  const Vector7 expected{20, 10, 5, -4, -3, -2, 1};
  EXPECT_LT((responses[0].stress - expected).norm(), 1e-12);
}

TEST(large_deformation, a_block_turned_by_a_full_circle_feels_nothing) {
  Problem<2> problem = elastic_block({{2.0, 1.0}, {2, 1}}, {1e6, 0.3, 1e5, 0.1, Vector7::Zero()});
  constexpr int kSteps = 12;
  std::vector<TimeTable::Point> cosine;
  std::vector<TimeTable::Point> sine;
  for (int step = 0; step <= kSteps; ++step) {
    const double time = static_cast<double>(step) / kSteps;
    cosine.push_back({time, std::cos(2 * M_PI * time) - 1});
    sine.push_back({time, std::sin(2 * M_PI * time)});
  }
  const auto distance = [](const Eigen::Vector2d& x) { return x(0); };
  problem.prescribed = {{"bottom", Dof::u1, TimeTable(cosine), distance},
                        {"bottom", Dof::u2, TimeTable(sine), distance},
                        {"bottom", Dof::w, TimeTable::ramp(2 * M_PI), {}}};
  SolverOptions options;
  options.reference_force = 1e5;
  Solver<2> solver(std::move(problem), options);
  ASSERT_TRUE(solver.equilibrate().converged);
  int iterations = 0;
  for (int step = 1; step <= kSteps; ++step) {
    const StepReport report = solver.advance(static_cast<double>(step) / kSteps);
    ASSERT_TRUE(report.converged) << report.message;
    iterations += report.iterations;
  }
  double largest = 0.0;
  for (const Response<2>& response : solver.state().responses)
    largest = std::max(largest, response.stress.norm());
  double farthest = 0.0;
  for (Eigen::Index i = 0; i < solver.state().displacement.size(); ++i) {
    if (i % 3 != 2) farthest = std::max(farthest, std::abs(solver.state().displacement(i)));
  }
  std::cout << "[figure] full circle in 12 steps: largest stress over E " << largest / 1e6
            << ", farthest node " << farthest << ", iterations " << iterations << '\n';
  EXPECT_LT(largest / 1e6, 1e-7);  // what the tolerance of the balance leaves
  EXPECT_LT(farthest, 1e-6);
}

TEST(large_deformation, pressure_all_round_compresses_by_the_exponential) {
  // nu = 0 and the same pressure on every side: the stress is -p and rates add up to ln(size) = -p / E.
  Problem<2> problem = elastic_block({{2.0, 1.0}, {3, 2}}, {1e6, 0.0, 1e5, 0.1, Vector7::Zero()});
  problem.prescribed = {{"bottom_left", Dof::u1, kZeroOfLarge, {}},
                        {"bottom_left", Dof::u2, kZeroOfLarge, {}},
                        {"bottom_right", Dof::u2, kZeroOfLarge, {}}};
  for (const char* side : {"left", "right", "bottom", "top"}) {
    problem.boundary_loads.push_back({.on = side, .pressure = TimeTable::ramp(0.05e6)});
  }
  Solver<2> solver(std::move(problem), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  constexpr int kSteps = 20;
  int iterations = 0;
  for (int step = 1; step <= kSteps; ++step) {
    const StepReport report = solver.advance(static_cast<double>(step) / kSteps);
    ASSERT_TRUE(report.converged) << report.message;
    iterations += report.iterations;
  }
  for (const Response<2>& response : solver.state().responses) {
    EXPECT_NEAR(response.stress(k11), -0.05e6, 1.0);
    EXPECT_NEAR(response.stress(k22), -0.05e6, 1.0);
  }
  const double width = 2.0 + solver.mean_displacement("right")(0) - solver.mean_displacement("left")(0);
  const double error = width / (2.0 * std::exp(-0.05)) - 1;
  std::cout << "[figure] pressure 0.05 E all round: relative error of the width " << error << ", iterations "
            << iterations << '\n';
  EXPECT_LT(std::abs(error), 1e-5);  // midpoint rule: step^2 / 12 of a strain of 0.05
}

/// Fixed below, free above: pi^2 E I / (2 L)^2 at time 1. Nothing pushes it aside, and Newton's iterations follow the
/// straight path.
Problem<2> column_under_twice_the_load_of_euler() {
  Problem<2> problem = elastic_block({{0.1, 4.0}, {1, 10}}, {100e6, 0.0, 50e6, 0.1, Vector7::Zero()});
  problem.continuum = Continuum::cauchy;
  problem.prescribed = {{"bottom", Dof::u1, kZeroOfLarge, {}}, {"bottom", Dof::u2, kZeroOfLarge, {}}};
  const double euler = std::pow(M_PI / 8.0, 2) * 100e6 * std::pow(0.1, 3) / 12.0;  // N/m
  problem.boundary_loads = {{.on = "top"}};
  problem.boundary_loads.front().traction[1] = TimeTable::ramp(-2.0 * euler / 0.1, 2.0);
  return problem;
}

TEST(large_deformation, a_column_beyond_the_load_of_euler_is_unstable) {
  Solver<2> solver(column_under_twice_the_load_of_euler(), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  // The step to come looks at the state before it; the shear and the strain of 1e-4 move the load by less than 1 %.
  for (const double load : {0.5, 0.95, 1.05}) {
    ASSERT_TRUE(solver.advance(load).converged);
    EXPECT_FALSE(solver.has_lost_stability()) << load;
  }
  ASSERT_TRUE(solver.advance(1.06).converged);
  EXPECT_TRUE(solver.has_lost_stability());
}

// No step comes after the last one.
TEST(large_deformation, a_column_that_ends_beyond_the_load_of_euler_is_unstable) {
  for (const double end : {0.95, 1.05}) {
    Solver<2> solver(column_under_twice_the_load_of_euler(), {});
    ASSERT_TRUE(solver.equilibrate().converged);
    for (const double load : {0.5, end}) ASSERT_TRUE(solver.advance(load).converged);
    const double before = solver.mean_displacement("top")(1);
    EXPECT_EQ(solver.has_lost_stability_at_end(), end > 1.0) << end;
    EXPECT_EQ(solver.mean_displacement("top")(1), before);
  }
}

TEST(large_deformation, tangent_under_pressure_is_the_derivative_of_the_residual) {
  // Forces of a pressure on the moved boundary against central differences, which are exact for what is
  // linear in the place of the nodes: rounding is all that may differ.
  for (const char* element : {"Q8R", "Q4", "T6"}) {
    Problem<2> problem = elastic_block({{2.0, 1.0}, {3, 2}}, {1e6, 0.3, 1e5, 0.1, Vector7::Zero()});
    problem.mesh = rectangle({{2.0, 1.0}, {3, 2}}, element);
    problem.boundary_loads = {{.on = "top", .pressure = TimeTable::ramp(2e5)},
                              {.on = "right", .pressure = TimeTable::constant(-1e5)}};
    Loads<2> loads(problem);
    Eigen::VectorXd place = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(problem.mesh.nodes.size()));
    for (Eigen::Index i = 0; i < place.size(); ++i) place(i) = 0.1 * std::sin(1.7 * static_cast<double>(i));
    Eigen::VectorXd way = place;
    for (Eigen::Index i = 0; i < way.size(); ++i) way(i) = std::cos(2.3 * static_cast<double>(i));
    constexpr double kStep = 1e-3;
    loads.move_to(place + kStep * way);
    const Eigen::VectorXd after = loads.at(0.7);
    loads.move_to(place - kStep * way);
    const Eigen::VectorXd difference = (after - loads.at(0.7)) / (2 * kStep);
    const double error = (loads.linearised(0.7, way) - difference).norm() / difference.norm();
    std::cout << "[figure] stiffness of a following pressure, " << element
              << ": relative error against central differences " << error << '\n';
    EXPECT_LT(error, 1e-11);  // 1e-16 over the step of 1e-3, with room
  }
}

TEST(large_deformation, newton_converges_quadratically_under_a_following_pressure) {
  Problem<2> problem = elastic_block({{2.0, 1.0}, {4, 2}}, {1e6, 0.3, 1e5, 0.1, Vector7::Zero()});
  problem.prescribed = {{"bottom", Dof::u1, kZeroOfLarge, {}}, {"bottom", Dof::u2, kZeroOfLarge, {}}};
  // Two tenths of Young's modulus on one side in five steps: bends and shears the block.
  problem.boundary_loads = {{.on = "left", .pressure = TimeTable::ramp(0.2e6)}};
  SolverOptions options;
  options.force_tolerance = options.moment_tolerance = 1e-12;
  Solver<2> solver(std::move(problem), options);
  ASSERT_TRUE(solver.equilibrate().converged);
  StepReport report;
  for (int step = 1; step <= 5; ++step) {
    report = solver.advance(step / 5.0);
    ASSERT_TRUE(report.converged) << report.message;
    EXPECT_EQ(report.cuts, 0);
  }
  std::cout << "[figure] pressure of 0.2 E on one side, residuals of the last step:";
  for (const double residual : report.force_residuals) std::cout << ' ' << residual;
  std::cout << '\n';
  const std::vector<double>& r = report.force_residuals;
  ASSERT_GE(r.size(), 3U);
  // Each below ten times the square of the one before while above rounding; without the stiffness of the
  // pressure they fall by a constant factor.
  for (std::size_t i = 1; i < r.size(); ++i) EXPECT_LT(r[i], std::max(10.0 * r[i - 1] * r[i - 1], 1e-12));
}

TEST(large_deformation, a_strip_is_bent_into_a_half_circle) {
  constexpr double kLength = 1.0;
  constexpr double kDepth = 0.02;
  constexpr double kYoung = 1e9;
  constexpr double kLengthScale = 0.005;
  Problem<2> problem =
      elastic_block({{kLength, kDepth}, {40, 1}}, {kYoung, 0.0, 0.2e9, kLengthScale, Vector7::Zero()});
  problem.prescribed = {{"left", Dof::u1, kZeroOfLarge, {}},
                        {"bottom_left", Dof::u2, kZeroOfLarge, {}},
                        {"left", Dof::w, kZeroOfLarge, {}}};
  // docs/theory.md, E.1b: bending stiffness with couples; nu = 0, so G = E / 2.
  const double stiffness = kYoung * std::pow(kDepth, 3) / 12 + kYoung * kLengthScale * kLengthScale * kDepth;
  const double moment = stiffness * M_PI / kLength;
  problem.boundary_loads.push_back({.on = "right"});
  problem.boundary_loads.back().couple_traction[0] = TimeTable::ramp(moment / kDepth);
  SolverOptions options;
  options.reference_force = kYoung * kDepth * 0.03;
  Solver<2> solver(std::move(problem), options);
  ASSERT_TRUE(solver.equilibrate().converged);
  constexpr int kSteps = 20;
  StepReport last;
  int iterations = 0;
  int cuts = 0;
  for (int step = 1; step <= kSteps; ++step) {
    last = solver.advance(static_cast<double>(step) / kSteps);
    ASSERT_TRUE(last.converged) << last.message;
    iterations += last.iterations;
    cuts += last.cuts;
  }
  // A half circle of length 1: its end lies 2 / pi above and back over the root.
  const Eigen::Vector3d end = solver.mean_displacement("right");
  std::cout << "[figure] strip bent by pi: end at (" << kLength + end(0) << ", " << end(1) << "), exact (0, "
            << 2 / M_PI << "), rotation " << end(2) << ", iterations " << iterations << ", cuts " << cuts
            << ", last step";
  for (const double residual : last.force_residuals) std::cout << ' ' << residual;
  std::cout << '\n';
  EXPECT_NEAR(kLength + end(0), 0.0, 0.01);
  EXPECT_NEAR(end(1) / (2 / M_PI), 1.0, 0.01);  // strains of 3 % and the layer where the couple is applied
}

TEST(large_deformation, an_element_turned_inside_out_is_named) {
  Problem<2> problem = elastic_block({{2.0, 1.0}, {2, 1}}, {1e6, 0.0, 1e5, 0.1, Vector7::Zero()});
  // The top is pushed through the bottom in one go.
  problem.prescribed = {{"bottom", Dof::u2, kZeroOfLarge, {}},
                        {"bottom_left", Dof::u1, kZeroOfLarge, {}},
                        {"top", Dof::u2, TimeTable::ramp(-1.5), {}}};
  SolverOptions options;
  options.most_cuts = 0;
  options.largest_strain = 10.0;  // by default such a step is not even tried
  Solver<2> solver(std::move(problem), options);
  ASSERT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.message.find("element 0 is turned inside out"), std::string::npos) << report.message;
  EXPECT_EQ(solver.state().displacement.norm(), 0.0);
}

}  // namespace
