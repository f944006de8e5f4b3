// SPDX-License-Identifier: GPL-2.0-or-later
// Explicit steps against Newton's method and closed forms (docs/theory/explicit.md).
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <iostream>

#include "common/memory_archive.hpp"
#include "fem/solver/explicit_pace.hpp"
#include "fem/solver/explicit_rate.hpp"
#include "fem/solver/nodal_masses.hpp"
#include "fem/solver/quasi_static.hpp"
#include "tests/support/explicit_bodies.hpp"

namespace polargrain::testing::explicit_bodies {
namespace {

TEST(explicit_pace, comes_to_its_speed_evenly_and_ends_where_it_should) {
  const ExplicitPace pace(2.0, 3.0, 100, 20, 0);
  EXPECT_EQ(pace.steps(), 110);
  EXPECT_EQ(pace.time(0), 2.0);
  EXPECT_EQ(pace.time(110), 3.0);
  const double rate = pace.time(110) - pace.time(109);
  EXPECT_NEAR(pace.time(50) - pace.time(49), rate, 1e-12);
  EXPECT_NEAR(pace.time(1) - pace.time(0), rate / 20.0, 1e-12);
  EXPECT_NEAR(rate, 1.0 / 100.0, 1e-4);  // that of the rows to follow
  const ExplicitPace moving(0.0, 1.0, 4, 20, 20);
  EXPECT_EQ(moving.steps(), 4);
  for (int step = 0; step <= 4; ++step) EXPECT_DOUBLE_EQ(moving.time(step), step / 4.0);
}

// A ramp may be longer than a row: the speed goes on growing in the next one, without a jump.
TEST(explicit_pace, ramps_go_on_in_the_next_row) {
  const ExplicitPace first(0.0, 1.0, 4, 40, 0);
  EXPECT_EQ(first.steps(), 18);  // 18 * 19 / 80 = 4.3
  const ExplicitPace second(1.0, 2.0, 4, 40, first.steps());
  const double last = first.time(18) - first.time(17);
  const double next = second.time(1) - second.time(0);
  EXPECT_NEAR(next / last, 19.0 / 18.0, 0.1);  // rows end between two steps
  EXPECT_EQ(second.time(second.steps()), 2.0);
}

// A rate that changes from row to row has no jump between them, and comes to its even speed within the time of a wave.
TEST(explicit_pace, changes_its_speed_evenly) {
  constexpr int kMoving = 1 << 20;
  const ExplicitPace slower(0.0, 1.0, 200, 40, kMoving, 2.0, 50);
  EXPECT_LT(slower.steps(), 200);  // it is faster at first
  const double even = slower.time(slower.steps() - 1) - slower.time(slower.steps() - 2);
  EXPECT_NEAR((slower.time(1) - slower.time(0)) / even, 2.0 - 1.0 / 50.0, 1e-9);
  EXPECT_NEAR((slower.time(25) - slower.time(24)) / even, 1.5, 1e-9);
  EXPECT_NEAR((slower.time(60) - slower.time(59)) / even, 1.0, 1e-9);
  EXPECT_EQ(slower.time(slower.steps()), 1.0);
}

// By hand: an error of twice its tolerance asks for 0.35 of the speed, and gets half of it; room is taken up by a quarter a wave.
TEST(explicit_rate, falls_at_once_and_rises_little_by_little) {
  const ExplicitRate rate{.error = 0.01};
  StepReport row;
  row.explicit_steps = 100;
  row.speed = 1.0;
  row.quasi_static.reaction_difference = 0.02;
  EXPECT_DOUBLE_EQ(rate.next_speed(row, 100), 0.5);
  row.quasi_static.reaction_difference = 0.01;
  EXPECT_DOUBLE_EQ(rate.next_speed(row, 100), 0.7);
  row.quasi_static.reaction_difference = 0.007;
  EXPECT_DOUBLE_EQ(rate.next_speed(row, 100), 1.0);
  row.quasi_static.reaction_difference = 0.001;
  EXPECT_DOUBLE_EQ(rate.next_speed(row, 100), 1.25);
  EXPECT_DOUBLE_EQ(rate.next_speed(row, 200), std::sqrt(1.25));
  row.quasi_static.kinetic_share = 0.2;  // four times its tolerance: twice too fast
  EXPECT_DOUBLE_EQ(rate.next_speed(row, 100), 0.5);
  row.speed = rate.slowest;
  EXPECT_DOUBLE_EQ(rate.next_speed(row, 100), rate.slowest);
  row.explicit_steps = 0;  // balanced by iterations
  row.speed = 0.8;
  EXPECT_DOUBLE_EQ(rate.next_speed(row, 100), 0.8);
}

// Whoever says what error is allowed gets a rate that keeps it, from any start.
TEST(explicit_rate, keeps_the_error_that_is_allowed) {
  for (const double allowed : {0.03, 0.01}) {
    const ExplicitRate rate{.error = allowed};
    for (const int start : {10, 160}) {
      Solver<2> newton(biaxial(), {});
      ASSERT_TRUE(newton.equilibrate().converged);
      Solver<2> solver(biaxial(), {});
      ASSERT_TRUE(solver.begin_explicit().converged);
      StepReport row;
      constexpr int kRows = 20;
      double largest = 0.0;
      for (int k = 1; k <= kRows; ++k) {
        const double before = row.speed;
        const double speed = rate.next_speed(row, solver.steps_of_wave());
        row = solver.advance_explicit(static_cast<double>(k) / kRows,
                                      static_cast<int>(std::ceil(start / speed)),
                                      {.speed_before = before / speed});
        row.speed = speed;
        ASSERT_TRUE(newton.advance(static_cast<double>(k) / kRows).converged);
        if (k > kRows / 2)
          largest = std::max(largest, std::abs(force_on_top(solver) / force_on_top(newton) - 1.0));
      }
      std::cout << "[figure] allowed " << allowed << ", from " << start << " steps a row: speed " << row.speed
                << ", estimate " << row.quasi_static.error() << ", error " << largest << '\n';
      EXPECT_LT(largest, allowed);
      EXPECT_LT(row.quasi_static.error(), 2.0 * allowed);  // of one row
    }
  }
}

// Every element type: the largest eigenvalue of the whole mesh, supports left out, is at most 4 safety^2, and not far below.
TEST(nodal_masses, make_steps_of_one_stable_and_not_much_slower) {
  for (const char* const type : {"Q4", "Q8", "Q8R", "T6"}) {
    const Mesh<2> mesh = rectangle({{0.04, 0.06}, {2, 3}}, type);
    const Discretisation<2> discretisation(mesh, Continuum::cosserat);
    std::vector<Response<2>> answers(discretisation.points());
    for (Response<2>& answer : answers) answer.tangent = elastic_stiffness(sand_of_explicit());
    const Linearisation<2> of{answers};
    const Eigen::VectorXd masses = nodal_masses(discretisation, of, 0.6);
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(masses.size(), masses.size());
    for (std::size_t e = 0; e < discretisation.elements(); ++e)
      stiffness(discretisation.element_dofs(e), discretisation.element_dofs(e)) +=
          discretisation.element_tangent(e, of);
    const Eigen::VectorXd root = masses.cwiseSqrt().cwiseInverse();
    const double largest =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(root.asDiagonal() * stiffness * root.asDiagonal())
            .eigenvalues()
            .maxCoeff();
    EXPECT_LE(largest, 4.0 * 0.36 * (1.0 + 1e-12)) << type;
    EXPECT_GE(largest, 4.0 * 0.36 * 0.5) << type;
  }
}

// A bar, one element wide, is hit at one end: the front runs at sqrt(M / rho), rho from the masses.
TEST(explicit_steps, send_waves_at_the_speed_of_the_modulus) {
  Problem<2> problem;
  problem.mesh = rectangle({{1.0, 0.02}, {50, 1}});
  problem.continuum = Continuum::cauchy;
  ElasticParameters<2> parameters = sand_of_explicit();
  parameters.initial_stress.setZero();
  problem.materials["all"] = std::make_shared<LocalMaterial<ElasticLaw<2>>>(ElasticLaw<2>(parameters));
  const TimeTable zero = TimeTable::constant(0.0);
  problem.prescribed = {{"bottom", Dof::u2, zero, {}},
                        {"top", Dof::u2, zero, {}},
                        {"right", Dof::u1, zero, {}},
                        {"left", Dof::u1, TimeTable::ramp(0.02), {}}};
  Solver<2> solver(problem, {});
  ASSERT_TRUE(solver.begin_explicit().converged);
  constexpr int kSteps = 140;
  ASSERT_TRUE(solver.advance_explicit(1.0, kSteps, {.ramp = 20}).converged);
  const Discretisation<2> discretisation(problem.mesh, problem.continuum);
  std::vector<Response<2>> answers(discretisation.points());
  for (Response<2>& answer : answers) answer.tangent = elastic_stiffness(parameters);
  const double mass =
      nodal_masses(discretisation, {answers}, 0.6).sum();  // of two directions, and nothing else
  double volume = 0.0;
  for (std::size_t i = 0; i < discretisation.points(); ++i) volume += discretisation.point(i).volume;
  double rotary = 0.0;
  const Eigen::VectorXd all = nodal_masses(discretisation, {answers}, 0.6);
  for (Eigen::Index entry = 2; entry < all.size(); entry += 3) rotary += all(entry);
  const double density = (mass - rotary) / 2.0 / volume;
  const double speed = std::sqrt(elastic_stiffness(parameters)(k11, k11) / density);  // m a step
  // Where the strain has half of its height behind the front: the ramp of 20 steps puts the middle of the front 10 steps back.
  const double height = 0.02 / (kSteps * speed);
  double front = 0.0;
  for (std::size_t i = 0; i < solver.points(); ++i)
    if (-solver.state().strain[i](k11) > 0.5 * height)
      front = std::max(front, solver.position_of_point(i).x());
  EXPECT_NEAR(front / (speed * (kSteps + 10 - 10)), 1.0, 0.02);
}

// Whoever takes steps that are too long hears of it.
TEST(explicit_steps, tell_when_they_are_unstable) {
  SolverOptions options;
  options.largest_strain = 0.05;
  Solver<2> solver(biaxial(), options);
  ASSERT_TRUE(solver.begin_explicit().converged);
  const StepReport report = solver.advance_explicit(1.0, 3000, {.safety = 1.2});
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.message.find("the nodes move too fast"), std::string::npos) << report.message;
  EXPECT_LT(report.time, 1.0);
}

// Forces that are out of balance at time 0 come in, and do not hit.
TEST(explicit_steps, let_imbalance_in_slowly) {
  Problem<2> problem = biaxial(Deformation::small, 0.0);
  problem.boundary_loads[0].pressure = problem.boundary_loads[1].pressure =
      TimeTable::constant(0.5 * kPressure);
  Solver<2> newton(problem, {});
  ASSERT_TRUE(newton.equilibrate().converged);
  problem.materials["all"] = elastic();
  Solver<2> solver(problem, {});
  ASSERT_TRUE(solver.begin_explicit().converged);
  ASSERT_TRUE(solver.advance_explicit(1.0, 4000).converged);
  EXPECT_NEAR(force_on_top(solver), force_on_top(newton), 0.005 * std::abs(force_on_top(newton)));
}

// Forces that grow evenly are met exactly, what swings within the time of a wave is gone, and a row shorter than two waves
// keeps its last step.
TEST(row_of_forces, ends_on_the_line_through_its_last_means) {
  const Problem<2> problem = biaxial();
  const Constraints<2> constraints(problem);
  const std::size_t held = problem.mesh.nodes_on("bottom").front();
  const auto entry = static_cast<Eigen::Index>(entry_of<2>(held, Dof::u2));
  const int size = static_cast<int>(3 * problem.mesh.nodes.size());
  const auto reaction_of = [&](int steps, int fitted, auto force) {
    std::vector<double> times;
    for (int k = steps - fitted + 1; k <= steps; ++k) times.push_back(0.01 * k);
    RowOfForces row(constraints, steps, times);
    for (int k = 1; k <= steps; ++k) {
      Eigen::VectorXd supplied = Eigen::VectorXd::Zero(size);
      supplied(entry) = force(k);
      row.add(supplied);
    }
    return row.reactions()(entry);
  };
  EXPECT_NEAR(reaction_of(100, 40, [](int k) { return 3.0 + 0.5 * k; }), 53.0, 1e-10);
  for (const double phase : {0.0, 1.0, 2.0})
    EXPECT_NEAR(reaction_of(100, 40, [&](int k) { return std::sin(phase + 0.31415926535897932 * k); }), 0.0,
                1e-10);
  EXPECT_DOUBLE_EQ(reaction_of(30, 0, [](int k) { return k < 30 ? 0.0 : 7.0; }), 7.0);
}

// By hand: 3 and 4 N/m at a free node, unbalanced by turns, over 10 N/m that go in and out along 2.
TEST(row_of_forces, tells_what_supports_and_loads_leave_unbalanced) {
  const Problem<2> problem = biaxial();
  const Constraints<2> constraints(problem);
  const auto held = static_cast<Eigen::Index>(
      entry_of<2>(static_cast<std::size_t>(problem.mesh.nodes_on("bottom").front()), Dof::u2));
  std::size_t free = 0;
  while (!constraints.is_free(entry_of<2>(free, Dof::u2))) ++free;
  RowOfForces row(constraints, 2, {});
  Eigen::VectorXd supplied = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * problem.mesh.nodes.size()));
  Eigen::VectorXd loads = supplied;
  supplied(held) = 10.0;
  loads(static_cast<Eigen::Index>(entry_of<2>(free, Dof::u2))) = -10.0;
  for (const double force : {3.0, -4.0}) {
    supplied(static_cast<Eigen::Index>(entry_of<2>(free, Dof::u2))) = force;
    row.add(supplied);
  }
  EXPECT_DOUBLE_EQ(row.difference(loads), std::sqrt(12.5) / 10.0);
}

// What a run says of itself holds here, where the answer is known: over the rows the error of the reaction is below the estimate,
// at any pace, and the estimate falls with the pace.
TEST(explicit_steps, estimate_the_error_of_their_reactions) {
  constexpr int kRows = 10;
  double before = HUGE_VAL;
  for (const int steps : {200, 800, 3200}) {
    Solver<2> newton(biaxial(), {});
    ASSERT_TRUE(newton.equilibrate().converged);
    Solver<2> solver(biaxial(), {});
    ASSERT_TRUE(solver.begin_explicit().converged);
    double error = 0.0;
    double estimate = 0.0;
    for (int row = 1; row <= kRows; ++row) {
      ASSERT_TRUE(newton.advance(0.1 * row).converged);
      const StepReport report = solver.advance_explicit(0.1 * row, steps / kRows);
      error += std::pow(force_on_top(solver) / force_on_top(newton) - 1.0, 2);
      estimate += std::pow(report.quasi_static.error(), 2);
      EXPECT_GT(report.quasi_static.kinetic_share, 0.0);
      EXPECT_EQ(report.quasi_static.hot_points, 0.0);  // a law has no grains
    }
    std::cout << "[figure] " << steps << " steps: error over estimate " << std::sqrt(error / estimate)
              << '\n';
    EXPECT_LT(error, estimate) << steps;
    EXPECT_LT(estimate, 0.25 * before) << steps;
    before = estimate;
  }
}

// Brought to rest, a fast row is where Newton's method is, to the residual that was asked for.
TEST(explicit_steps, come_to_rest) {
  Solver<2> newton(biaxial(), {});
  ASSERT_TRUE(newton.equilibrate().converged);
  ASSERT_TRUE(newton.advance(1.0).converged);
  Solver<2> solver(biaxial(), {});
  ASSERT_TRUE(solver.begin_explicit().converged);
  const StepReport report = solver.advance_explicit(1.0, 100, {.rest = 1e-4});
  ASSERT_TRUE(report.converged) << report.message;
  EXPECT_GT(report.rest_steps, 10);
  EXPECT_EQ(report.time, 1.0);
  EXPECT_LE(report.force_residual, 1e-4);
  EXPECT_NEAR(force_on_top(solver) / force_on_top(newton), 1.0, 1e-3);
  EXPECT_TRUE(solver.state().velocity.isZero(0.0));
}

// Longer ways: explicit_bodies_test.
TEST(explicit_steps, take_large_deformation) {
  Solver<2> solver(biaxial(Deformation::large), {});
  ASSERT_TRUE(solver.begin_explicit().converged);
  const StepReport report = solver.advance_explicit(0.1, 50);
  EXPECT_TRUE(report.converged) << report.message;
  EXPECT_LT(force_on_top(solver), -kPressure * 0.04);
}

TEST(explicit_steps, go_on_from_an_archive_to_the_same_bits) {
  Solver<2> through(biaxial(), {});
  ASSERT_TRUE(through.begin_explicit().converged);
  ASSERT_TRUE(through.advance_explicit(0.5, 200).converged);
  MemoryArchive archive;
  through.save(archive);
  ASSERT_TRUE(through.advance_explicit(1.0, 200).converged);
  Solver<2> again(biaxial(), {});
  again.restore(archive);
  ASSERT_TRUE(again.advance_explicit(1.0, 200).converged);
  EXPECT_EQ(again.state().displacement, through.state().displacement);
  EXPECT_EQ(again.state().velocity, through.state().velocity);
}

// The imbalance at time 0 comes in over the first row: a run that was ended before it must hold it back again.
TEST(explicit_steps, go_on_from_their_begin_to_the_same_bits) {
  const auto problem = [] {
    Problem<2> made = biaxial();
    for (auto& load : made.boundary_loads) load.pressure = TimeTable::constant(1.2 * kPressure);
    return made;
  };
  Solver<2> through(problem(), {});
  ASSERT_TRUE(through.begin_explicit().converged);
  MemoryArchive archive;
  through.save(archive);
  ASSERT_TRUE(through.advance_explicit(0.5, 200).converged);
  Solver<2> again(problem(), {});
  again.restore(archive);
  ASSERT_TRUE(again.advance_explicit(0.5, 200).converged);
  EXPECT_EQ(again.state().displacement, through.state().displacement);
  EXPECT_EQ(again.state().velocity, through.state().velocity);
}

// A rotation that is given, or a moment, meets no force of a support in the first step. Newton's method is exact.
TEST(explicit_steps, begin_where_no_force_reacts) {
  for (const bool is_given : {true, false}) {
    const auto problem = [is_given] {
      Problem<2> made;
      made.mesh = rectangle({{0.1, 0.2}, {1, 2}});
      made.materials["all"] = std::make_shared<LocalMaterial<ElasticLaw<2>>>(
          ElasticLaw<2>({10e6, 0.25, 4e6, 0.02, Vector7::Zero()}));
      for (const Dof dof : {Dof::u1, Dof::u2, Dof::w})
        made.prescribed.push_back({"bottom", dof, TimeTable::constant(0.0), {}});
      if (is_given) {
        made.prescribed.push_back({"top", Dof::w, TimeTable::ramp(0.02), {}});
      } else {
        made.node_loads.push_back({"top", Dof::w, TimeTable::ramp(100.0)});
      }
      return made;
    };
    Solver<2> newton(problem(), {});
    ASSERT_TRUE(newton.equilibrate().converged);
    ASSERT_TRUE(newton.advance(1.0).converged);
    Solver<2> solver(problem(), {});
    ASSERT_TRUE(solver.begin_explicit().converged);
    ASSERT_TRUE(solver.advance_explicit(0.5, 1500).converged);
    const double reference = solver.state().reference_force;
    const StepReport report = solver.advance_explicit(1.0, 1500);
    ASSERT_TRUE(report.converged) << report.message;
    const Eigen::VectorXd& exact = newton.state().displacement;
    EXPECT_LT((solver.state().displacement - exact).cwiseAbs().maxCoeff(),
              0.01 * exact.cwiseAbs().maxCoeff());
    EXPECT_LT(report.quasi_static.nodes_unbalanced, 0.01);
    EXPECT_LT(report.moment_residual, 0.01);
    EXPECT_GT(reference, 0.0);
    EXPECT_EQ(solver.state().reference_force, reference);
  }
}

}  // namespace
}  // namespace polargrain::testing::explicit_bodies
