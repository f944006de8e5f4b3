// SPDX-License-Identifier: GPL-2.0-or-later
// Explicit steps against Newton's method, through squeezing and turning (docs/theory/explicit.md).
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/support/explicit_bodies.hpp"

namespace polargrain::testing::explicit_bodies {
namespace {

// The mean over a row of steps is compared: waves come and go.
TEST(explicit_steps, agree_with_newton_where_they_are_slow) {
  for (const Deformation deformation : {Deformation::small, Deformation::large}) {
    Solver<2> newton(biaxial(deformation), {});
    ASSERT_TRUE(newton.equilibrate().converged);
    ASSERT_TRUE(newton.advance(1.0).converged);
    for (const int steps : {500, 4000}) {
      Solver<2> slow(biaxial(deformation), {});
      ASSERT_TRUE(slow.begin_explicit().converged);
      const StepReport report = slow.advance_explicit(1.0, steps);
      ASSERT_TRUE(report.converged) << report.message;
      EXPECT_EQ(report.time, 1.0);
      const double added = force_on_top(newton) + kPressure * 0.04;
      const double error = std::abs((force_on_top(slow) - force_on_top(newton)) / added);
      EXPECT_LT(error, steps == 500 ? 0.03 : 0.005);
      // What the supports and the loads have done is in the stresses, or moves.
      const double work = slow.state().internal_work;
      EXPECT_NEAR(slow.state().external_work, work, 0.01 * std::abs(work) * (steps == 500 ? 3.0 : 1.0));
    }
  }
}

// Elements that are squeezed swing faster: steps of 0.6 of the critical one at first are critical at 0.6 of the height, stiffness
// alike, and are shortened before. Newton's method, in as many rows, has the same force; behind 43 % the two part.
TEST(explicit_steps, stay_stable_where_elements_are_squeezed) {
  constexpr int kRows = 20;
  Solver<2> newton(biaxial(Deformation::large, 0.034), {});
  ASSERT_TRUE(newton.equilibrate().converged);
  Solver<2> solver(biaxial(Deformation::large, 0.034), {});
  ASSERT_TRUE(solver.begin_explicit().converged);
  int first = 0;
  int last = 0;
  for (int row = 1; row <= kRows; ++row) {
    ASSERT_TRUE(newton.advance(static_cast<double>(row) / kRows).converged);
    const StepReport report = solver.advance_explicit(static_cast<double>(row) / kRows, 400, {});
    ASSERT_TRUE(report.converged) << report.message;
    EXPECT_NEAR(force_on_top(solver) / force_on_top(newton), 1.0, 0.02) << row;
    if (row == 2) first = report.explicit_steps;
    last = report.explicit_steps;
  }
  std::cout << "[figure] explicit steps of a row: " << first << ", then " << last << '\n';
  EXPECT_GT(last, 1.25 * first);
}

// Turned by 28 degrees under pressures that follow it, and pressed on its top: the work of all forces is that of its stresses.
// Micro-rotations turn with the body; damped in space, they would hold it back.
TEST(explicit_steps, turn_a_body_without_drag) {
  const auto turned = [] {
    Problem<2> problem;
    problem.mesh = rectangle({{1.0, 1.0}, {2, 2}});
    problem.deformation = Deformation::large;
    problem.materials["all"] = elastic();
    problem.prescribed = {{"bottom_left", Dof::u1, TimeTable::constant(0.0), {}},
                          {"bottom_left", Dof::u2, TimeTable::constant(0.0), {}},
                          {"bottom_right", Dof::u1, TimeTable::ramp(-0.117), {}},
                          {"bottom_right", Dof::u2, TimeTable::ramp(0.46947), {}}};
    for (const char* const side : {"left", "right", "bottom"})
      problem.boundary_loads.push_back({.on = side, .pressure = TimeTable::constant(kPressure)});
    problem.boundary_loads.push_back(
        {.on = "top", .pressure = TimeTable({{0.0, kPressure}, {1.0, 2.0 * kPressure}})});
    return problem;
  };
  Solver<2> balanced(turned(), {});
  ASSERT_TRUE(balanced.equilibrate().converged);
  for (int step = 1; step <= 20; ++step) ASSERT_TRUE(balanced.advance(step / 20.0).converged);
  Solver<2> solver(turned(), {});
  ASSERT_TRUE(solver.begin_explicit().converged);
  for (int step = 1; step <= 20; ++step) ASSERT_TRUE(solver.advance_explicit(step / 20.0, 800, {}).converged);
  const double work = balanced.state().external_work;
  std::cout << "[figure] work of a body that is turned in explicit steps over that in balance: external "
            << solver.state().external_work / work << ", internal " << solver.state().internal_work / work
            << '\n';
  // The inertia of the chosen masses is left.
  EXPECT_NEAR(solver.state().external_work / work, 1.0, 0.1);
  EXPECT_NEAR(solver.state().internal_work / work, 1.0, 0.1);
}

}  // namespace
}  // namespace polargrain::testing::explicit_bodies
