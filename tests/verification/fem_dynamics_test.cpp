// SPDX-License-Identifier: GPL-2.0-or-later
// Explicit steps in real time against closed forms of waves (docs/theory/explicit.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iostream>
#include <numbers>

#include "tests/support/bodies_in_real_time.hpp"

namespace polargrain::testing::real_time {
namespace {

// A wave runs at sqrt(M / rho), carries rho c v, and comes back from a wall with twice that.
TEST(dynamics, a_wave_runs_through_a_bar_at_its_speed) {
  constexpr double kSpeed = 0.01, kRise = 0.01;
  for (const char* const element : {"Q4", "Q8R", "Q8"}) {
    Solver<2> solver(bar(kSpeed, kRise, element), {});
    ASSERT_TRUE(solver.begin_real_time().converged);
    const double c = speed_along();
    ASSERT_TRUE(solver.advance_real_time(0.02).converged);
    const double first = front_of(solver, kSpeed / c);
    ASSERT_TRUE(solver.advance_real_time(0.05).converged);
    const double second = front_of(solver, kSpeed / c);
    std::cout << "[figure] " << element << ": speed of the wave over that of the modulus "
              << (second - first) / (0.03 * c) << '\n';
    EXPECT_NEAR((second - first) / (0.03 * c), 1.0, 0.015) << element;
    EXPECT_NEAR(first, c * (0.02 - 0.5 * kRise), 0.1) << element;  // half an element
    // Reflected, and not yet back at the left end.
    const StepReport report = solver.advance_real_time(10.0 / c + 0.03);
    ASSERT_TRUE(report.converged);
    EXPECT_NEAR(-solver.reaction("right")(0), 2.0 * kDensity * c * kSpeed * 0.2, 0.05 * kDensity * c * kSpeed)
        << element;
    EXPECT_LT(report.energies.error(), kEnergy);
  }
}

// Bent by a force at its top and let go, a column that shears swings with 4 H / c: its top moves at an even speed there and back,
// and without `mass_damping` for ever. Micro-rotations take little from it, and from the tip of its zigzag alone.
TEST(dynamics, a_column_swings_with_its_period) {
  for (const Continuum continuum : {Continuum::cauchy, Continuum::cosserat}) {
    Problem<2> problem = column(20, continuum);
    problem.prescribed.push_back({"bottom", Dof::u1, kZeroOfDynamics, {}});
    BoundaryLoad<2> force{.on = "top"};
    force.traction[0] = TimeTable({{0.0, 1e3}, {1e-6, 0.0}});
    problem.boundary_loads = {force};
    Solver<2> solver(problem, {});
    ASSERT_TRUE(solver.begin_real_time().converged);
    std::vector<double> crossings;
    double before = solver.mean_displacement("top")(0);
    const double first = before;
    const double period = 4.0 * 10.0 / speed_across();
    constexpr int kLooks = 400;  // in two and a half periods
    for (int look = 1; look <= kLooks; ++look) {
      const double time = 2.5 * period * look / kLooks;
      const StepReport report = solver.advance_real_time(time);
      ASSERT_TRUE(report.converged);
      const double now = solver.mean_displacement("top")(0);
      EXPECT_LE(report.energies.damped, continuum == Continuum::cauchy ? 0.0 : 0.1 * 0.5 * 1e3 * first);
      if (look == 4 * kLooks / 5) {           // two periods: back where it was let go
        EXPECT_NEAR(now / first, 1.0, 0.07);  // the tip of a zigzag, rounded by the mesh
      }
      if (now * before < 0.0) crossings.push_back(time - 2.5 * period / kLooks * now / (now - before));
      before = now;
    }
    ASSERT_GE(crossings.size(), 4U);
    std::cout << "[figure] period over 4 H / c: " << (crossings[2] - crossings[0]) / period << '\n';
    EXPECT_NEAR((crossings[2] - crossings[0]) / period, 1.0, 0.01);
    EXPECT_NEAR(crossings[0] / (0.25 * period), 1.0, 0.01);
    EXPECT_NEAR(first, 1e3 * 10.0 / (40e6 / 2.6), 1e-3 * first);
  }
}

// Bent and let go, a beam turns as it swings. Micro-rotations that turn with it are not damped.
TEST(dynamics, a_beam_of_micro_rotations_swings_on) {
  Problem<2> problem = body({{1.0, 0.1}, {8, 1}}, "Q8R", Continuum::cosserat);
  problem.prescribed = {{"left", Dof::u1, kZeroOfDynamics, {}}, {"left", Dof::u2, kZeroOfDynamics, {}}};
  BoundaryLoad<2> force{.on = "right"};
  force.traction[1] = TimeTable({{0.0, 100.0}, {1e-6, 0.0}});
  problem.boundary_loads = {force};
  Solver<2> solver(std::move(problem), {});
  ASSERT_TRUE(solver.begin_real_time().converged);
  const double stored = 0.5 * 100.0 * 0.1 * solver.mean_displacement("right")(1);
  double least = 0.0;
  double largest = 0.0;
  constexpr int kLooks = 200;
  for (int look = 1; look <= kLooks; ++look) {
    const StepReport report = solver.advance_real_time(3.0 * look / kLooks);
    ASSERT_TRUE(report.converged);
    EXPECT_LT(report.energies.error(), kEnergy);
    least = std::min(least, report.energies.damped);
    largest = std::max(largest, report.energies.damped);
  }
  std::cout << "[figure] energy of a beam that is damped in 3 s, %: " << 100.0 * largest / stored << '\n';
  EXPECT_LT(largest, 0.03 * stored);
  EXPECT_GT(least, -1e-3 * stored);
}

/// Energy that a pulse leaves behind in a body, over that which it brought in.
double left_behind(Problem<2> problem, double until) {
  Solver<2> solver(std::move(problem), {});
  EXPECT_TRUE(solver.begin_real_time().converged);
  double most = 0.0;
  StepReport report;
  for (int look = 1; look <= 20; ++look) {
    report = solver.advance_real_time(until * look / 20);
    EXPECT_TRUE(report.converged) << report.message;
    most = std::max(most, report.energies.kinetic + report.energies.internal);
    EXPECT_LT(report.energies.error(), kEnergy);
  }
  return (report.energies.kinetic + report.energies.internal) / most;
}

// Less than 1 % of a wave's height comes back: 1e-4 of its energy. Waves along and across the normal, some 15 elements long
// and more; kinks of shorter ones are waves of the mesh.
TEST(dynamics, quiet_boundaries_let_waves_out) {
  Problem<2> along = bar(0.0, 1.0);
  along.prescribed.erase(along.prescribed.begin() + 2, along.prescribed.end());
  BoundaryLoad<2> push{.on = "left", .pressure = TimeTable({{0.0, 0.0}, {0.01, 1e3}, {0.02, 0.0}})};
  along.boundary_loads = {push};
  along.prescribed.push_back({"right", Dof::u1, kZeroOfDynamics, {}});
  Problem<2> closed = along;
  along.quiet = {"right"};
  const double until = 25.0 / speed_along();
  const double echo = left_behind(along, until);
  Problem<2> across = column(50);
  BoundaryLoad<2> shear{.on = "top"};
  shear.traction[0] = TimeTable({{0.0, 0.0}, {0.04, 1e3}, {0.08, 0.0}});
  across.boundary_loads = {shear};
  across.prescribed.push_back({"bottom", Dof::u1, kZeroOfDynamics, {}});
  across.quiet = {"bottom"};
  const double shear_echo = left_behind(across, 25.0 / speed_across());
  std::cout << "[figure] energy left: " << echo << " along, " << shear_echo << " across\n";
  EXPECT_LT(echo, 1e-4);
  EXPECT_LT(shear_echo, 1e-4);
  closed.materials = body({{10.0, 0.2}, {50, 1}}).materials;
  EXPECT_GT(left_behind(closed, until), 0.9);  // so it is the boundary that does it
}

// A body under stress rests on a quiet boundary: the forces that held it stay, and nothing moves.
TEST(dynamics, quiet_boundaries_carry_what_rests_on_them) {
  constexpr double kPressure = 100e3;
  Problem<2> problem = body({{10.0, 0.2}, {20, 1}}, "Q8R", Continuum::cosserat, kPressure);
  problem.prescribed = {{"bottom", Dof::u2, kZeroOfDynamics, {}},
                        {"top", Dof::u2, kZeroOfDynamics, {}},
                        {"right", Dof::u1, kZeroOfDynamics, {}}};
  problem.boundary_loads = {{.on = "left", .pressure = TimeTable::constant(1.5 * kPressure)}};
  problem.quiet = {"right"};
  Solver<2> solver(problem, {});
  ASSERT_TRUE(solver.begin_real_time().converged);
  const double pushed = solver.mean_displacement("left")(0);
  EXPECT_GT(pushed, 0.0);
  EXPECT_NEAR(solver.reaction("right")(0) / (-1.5 * kPressure * 0.2), 1.0, 1e-6);
  ASSERT_TRUE(solver.advance_real_time(0.5).converged);
  EXPECT_NEAR(solver.reaction("right")(0) / (-1.5 * kPressure * 0.2), 1.0, 1e-6);
  EXPECT_NEAR(solver.mean_displacement("left")(0) / pushed, 1.0, 1e-6);
  EXPECT_NEAR(solver.mean_displacement("right")(0) / pushed, 0.0, 1e-6);
}

// A block is carried by its base at 1 m/s2: the base pushes with all of its mass, that of its own nodes too.
TEST(dynamics, a_base_carries_the_mass_of_its_own_nodes) {
  for (const char* const element : {"Q4", "Q8R", "T6"}) {
    Problem<2> problem = body({{1.0, 1.0}, {2, 2}}, element);
    // Rises within a tenth of a second, so that the block hardly rings.
    const TimeTable carried = TimeTable::of_accelerations({{0.0, 0.0}, {0.1, 1.0}, {1.05, 1.0}});
    problem.prescribed = {{"bottom", Dof::u1, carried, {}}, {"bottom", Dof::u2, kZeroOfDynamics, {}}};
    Solver<2> solver(problem, {});
    ASSERT_TRUE(solver.begin_real_time().converged);
    constexpr int kLooks = 1050;
    double impulse = 0.0;
    StepReport report;
    for (int look = 1; look <= kLooks; ++look) {
      report = solver.advance_real_time(1.05 * look / kLooks);
      ASSERT_TRUE(report.converged);
      impulse += solver.reaction("bottom")(0) * 1.05 / kLooks;
    }
    EXPECT_NEAR(impulse / kDensity, 1.0, 0.01) << element;  // 2000 kg at 1 m/s
    EXPECT_NEAR(report.energies.kinetic / (0.5 * kDensity), 1.0, 0.01) << element;
    EXPECT_LT(report.energies.error(), kEnergy);
  }
}

// A column shaken at its base, damped relative to it: amplitude of the top against the base as |b (1 / cos k H - 1)|, with the
// complex wave number k = sqrt(omega^2 - i omega alpha) / c and b = omega / (omega - i alpha).
TEST(dynamics, a_shaken_column_answers_as_its_transfer_function) {
  constexpr double kDamping = 3.0, kHeight = 10.0;
  for (const double frequency : {1.2, 2.2, 3.5}) {
    const double omega = 2.0 * std::numbers::pi * frequency;
    Problem<2> problem = column(10);
    std::vector<TimeTable::Point> shaking;
    const int periods = 12;
    for (int k = 0; k <= periods * 40; ++k) {
      const double time = k / (40.0 * frequency);
      shaking.push_back({time, std::min(1.0, time * frequency / 4.0) * std::sin(omega * time)});
    }
    problem.prescribed.push_back({"bottom", Dof::u1, TimeTable::of_accelerations(shaking), {}});
    Solver<2> solver(problem, {});
    const ExplicitOptions options{.mass_damping = kDamping};
    ASSERT_TRUE(solver.begin_real_time(options).converged);
    // Of the last two periods, less what goes on evenly.
    std::complex<double> top = 0.0, base = 0.0;
    constexpr int kLooks = 100;
    for (int look = 0; look <= 2 * kLooks; ++look) {
      const double time = (periods - 2) / frequency + look / (kLooks * frequency);
      const StepReport report = solver.advance_real_time(time, options);
      ASSERT_TRUE(report.converged);
      EXPECT_LT(report.energies.error(), kEnergy);
      if (look == 2 * kLooks) break;
      const std::complex<double> phase = std::polar(1.0, -omega * time);
      const double drift = solver.mean_displacement("bottom")(0);
      base += phase * drift;
      top += phase * (solver.mean_displacement("top")(0) - drift);
    }
    // The base by its acceleration of amplitude 1: its displacements drift.
    const double unit = kLooks / (omega * omega);  // sum of sin^2 over two periods times the amplitude
    const std::complex<double> k = std::sqrt(std::complex(omega * omega, -omega * kDamping)) / speed_across();
    const std::complex<double> inertia = omega / std::complex(omega, -kDamping);
    const double expected = std::abs(inertia * (1.0 / std::cos(k * kHeight) - 1.0));
    std::cout << "[figure] " << frequency << " Hz: top against base " << std::abs(top) / unit
              << ", closed form " << expected << '\n';
    EXPECT_NEAR(std::abs(top) / unit / expected, 1.0, 0.03) << frequency;
  }
}

// A column on a base that comes to 0.5 m/s and keeps it. Once it has swung out, which takes e^(-kDamping t / 2), nothing drags it:
// the base feels no force, and no energy is lost. Damped against the mesh at rest, the base would pull with kDamping m v = 200 kN.
TEST(dynamics, a_body_that_is_carried_along_evenly_is_not_damped) {
  constexpr double kDamping = 20.0, kSpeed = 0.5, kMass = 10.0 * kDensity;
  constexpr double kRest = 1e-6;  // e^-28 from 0.4 s to 3.2 s, with room for rounding
  Problem<2> problem = column(4);
  problem.prescribed.push_back(
      {"bottom", Dof::u1, TimeTable::of_accelerations({{0.0, 0.0}, {0.2, 5.0 * kSpeed}, {0.4, 0.0}}), {}});
  Solver<2> solver(problem, {});
  const ExplicitOptions options{.mass_damping = kDamping};
  ASSERT_TRUE(solver.begin_real_time(options).converged);
  const StepReport swung_out = solver.advance_real_time(3.2, options);
  ASSERT_TRUE(swung_out.converged) << swung_out.message;
  const double pull = kDamping * kMass * kSpeed;
  EXPECT_LT(std::abs(solver.reaction("bottom")(0)), kRest * pull);
  const StepReport report = solver.advance_real_time(4.0, options);
  ASSERT_TRUE(report.converged) << report.message;
  EXPECT_LT(std::abs(solver.reaction("bottom")(0)), kRest * pull);
  EXPECT_GT(swung_out.energies.damped, 0.0);
  EXPECT_NEAR(report.energies.damped / swung_out.energies.damped, 1.0, kRest);
  EXPECT_NEAR(report.energies.external / swung_out.energies.external, 1.0, kEnergy);
  EXPECT_LT(report.energies.error(), kEnergy);
}

// A base may be given by its accelerations or by its displacements. Straight lines over h lie up to e = h^2 a / 8 from the curve
// of an acceleration of a. At the top each pass of a wave brings twice that, nine passes within 2 s, and the dampers, which move
// with the base, kDamping * 2 s = 6 times: 24 e at most. Damped against the mesh at rest, the top is 4 mm elsewhere.
TEST(dynamics, a_base_that_is_moved_is_one_that_is_accelerated) {
  constexpr double kDamping = 3.0, kInterval = 0.01, kUntil = 2.0,
                   kMostDifference = 24.0 * kInterval * kInterval / 8.0;
  std::vector<TimeTable::Point> accelerations;
  for (int k = 0; k <= 200; ++k)
    accelerations.push_back(
        {k * kInterval, std::min(1.0, 0.01 * k) * std::sin(2.0 * std::numbers::pi * 1.2 * k * kInterval)});
  const TimeTable shaken = TimeTable::of_accelerations(accelerations);
  std::vector<TimeTable::Point> way;
  for (int k = 0; k <= 200; ++k) way.push_back({k * kInterval, shaken.at(k * kInterval)});
  std::vector<std::vector<double>> tops;
  for (const TimeTable& base : {shaken, TimeTable(way)}) {
    Problem<2> problem = column(4);
    problem.prescribed.push_back({"bottom", Dof::u1, base, {}});
    Solver<2> solver(problem, {});
    const ExplicitOptions options{.mass_damping = kDamping};
    ASSERT_TRUE(solver.begin_real_time(options).converged);
    std::vector<double>& top = tops.emplace_back();
    for (int look = 1; look <= 40; ++look) {
      ASSERT_TRUE(solver.advance_real_time(kUntil * look / 40, options).converged);
      top.push_back(solver.mean_displacement("top")(0));
    }
  }
  double difference = 0.0;
  for (std::size_t look = 0; look < tops[0].size(); ++look)
    difference = std::max(difference, std::abs(tops[1][look] - tops[0][look]));
  std::cout << "[figure] top of a moved column against that of an accelerated one: " << difference << " m\n";
  EXPECT_LT(difference, kMostDifference);
}

// In one row the balance of small deformation holds but for rounding. Large deformation has errors of its own, which stay small.
TEST(dynamics, energy_is_accounted_for) {
  Problem<2> problem = bar(1.0, 0.01);
  for (const Deformation deformation : {Deformation::small, Deformation::large}) {
    problem.deformation = deformation;
    problem.materials = bar(1.0, 0.01).materials;
    Solver<2> solver(problem, {});
    const ExplicitOptions options{.mass_damping = 5.0};
    ASSERT_TRUE(solver.begin_real_time(options).converged);
    const StepReport report = solver.advance_real_time(0.2, options);
    ASSERT_TRUE(report.converged) << report.message;
    std::cout << "[figure] energy error in one row " << report.energies.error() << '\n';
    EXPECT_LT(report.energies.error(), deformation == Deformation::small ? 1e-10 : 2e-3);
    EXPECT_GT(report.energies.damped, 0.0);
  }
}

}  // namespace
}  // namespace polargrain::testing::real_time
