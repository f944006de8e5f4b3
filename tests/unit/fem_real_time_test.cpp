// SPDX-License-Identifier: GPL-2.0-or-later
// Explicit steps in real time: base motion, supports, energies at rest, archives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/memory_archive.hpp"
#include "fem/solver/base_motion.hpp"
#include "tests/support/bodies_in_real_time.hpp"

namespace polargrain::testing::real_time {
namespace {

// An accelerated body: by hand, 2 m/s2 for 1 s, then down to nothing within 1 s.
TEST(time_table, displaces_what_is_accelerated) {
  const TimeTable table = TimeTable::of_accelerations({{0.0, 2.0}, {1.0, 2.0}, {2.0, 0.0}});
  EXPECT_EQ(table.at(-1.0), 0.0);
  EXPECT_NEAR(table.at(1.0), 1.0, 1e-15);
  EXPECT_NEAR(table.slope(1.0), 2.0, 1e-15);
  EXPECT_NEAR(table.at(2.0), 1.0 + 2.0 + 1.0 - 1.0 / 3.0, 1e-14);
  EXPECT_NEAR(table.slope(3.0), 3.0, 1e-14);
  EXPECT_NEAR(table.at(4.0) - table.at(3.0), 3.0, 1e-14);
}

// A load that a body bears from the start does work then, and none behind: what is left of its energies is rounding.
TEST(dynamics, a_body_at_rest_has_no_error_of_energy) {
  Problem<2> problem = body({{1.0, 1.0}, {1, 4}});
  problem.prescribed = {{"bottom", Dof::u2, kZeroOfDynamics, {}},
                        {"left", Dof::u1, kZeroOfDynamics, {}},
                        {"right", Dof::u1, kZeroOfDynamics, {}}};
  problem.boundary_loads = {{.on = "top", .pressure = TimeTable::constant(100e3)}};
  Solver<2> solver(problem, {});
  ASSERT_TRUE(solver.begin_real_time().converged);
  const double work = solver.state().external_work;
  EXPECT_GT(work, 1.0);
  for (int row = 1; row <= 5; ++row) {
    const StepReport report = solver.advance_real_time(0.01 * row);
    ASSERT_TRUE(report.converged);
    EXPECT_LT(std::abs(report.energies.external), 1e-10 * work);
    EXPECT_LT(report.energies.error(), kEnergy);
  }
}

// Energies above rounding count among themselves, however much work the start took.
TEST(dynamics, an_energy_that_is_missing_is_an_error) {
  const Energies wave{.kinetic = 0.4, .internal = 0.4, .external = 1.0, .at_start = 1e6};
  EXPECT_NEAR(wave.error(), 0.2, 1e-12);
}

// At a corner the support of the other boundary holds: the base is shaken between quiet sides, and keeps its height.
TEST(dynamics, quiet_boundaries_leave_the_supports_of_their_neighbours) {
  Problem<2> problem = body({{1.0, 1.0}, {4, 4}});
  const TimeTable shaken = TimeTable::of_accelerations({{0.0, 1.0}, {1.0, 1.0}});
  problem.prescribed = {{"bottom", Dof::u2, kZeroOfDynamics, {}}, {"bottom", Dof::u1, shaken, {}}};
  problem.quiet = {"left", "right"};
  Solver<2> solver(problem, {});
  ASSERT_TRUE(solver.begin_real_time().converged);
  ASSERT_TRUE(solver.advance_real_time(1.0).converged);
  const std::vector<int> corner = solver.problem().mesh.nodes_on("bottom_left");
  ASSERT_EQ(corner.size(), 1U);
  EXPECT_EQ(solver.state().displacement(entry_of<2>(corner.front(), Dof::u2)), 0.0);
  EXPECT_NEAR(solver.state().displacement(entry_of<2>(corner.front(), Dof::u1)), 0.5, 1e-12);
}

// Where one place stands and another is accelerated along the same axis, there is no base.
TEST(base_motion, is_that_of_all_supports_along_an_axis) {
  Problem<2> problem = bar(0.01, 0.01);
  const BaseAlong<2> two = base_along(problem, 0, Dof::u1);
  ASSERT_NE(two.item, nullptr);
  ASSERT_NE(two.other, nullptr);
  EXPECT_EQ(two.item->on, "left");
  EXPECT_EQ(two.other->on, "right");
  EXPECT_EQ(base_along(problem, 0, Dof::u2).item, nullptr);
  problem.quiet = {"right"};
  EXPECT_EQ(base_along(problem, 0, Dof::u1).other, nullptr);
  problem.quiet.clear();
  problem.prescribed.back().value = problem.prescribed[2].value;
  EXPECT_EQ(base_along(problem, 0, Dof::u1).other, nullptr);
  const BaseMotion<2> base(problem, Constraints<2>(problem), 0);
  const double speed = problem.prescribed[2].value.slope(0.004);
  EXPECT_GT(speed, 0.0);
  EXPECT_EQ(base.velocity(0.004).maxCoeff(), speed);
  EXPECT_EQ(base.velocity(0.004).minCoeff(), 0.0);  // across
}

// A movement is a base as an acceleration is, where nothing else along the axis stands or moves otherwise.
TEST(base_motion, is_that_of_a_movement_too) {
  Problem<2> problem = bar(0.01, 0.01);
  problem.prescribed[2].value = TimeTable({{0.0, 0.0}, {0.01, 1e-4}});
  EXPECT_EQ(base_along(problem, 0, Dof::u1).item, nullptr);  // it pushes against the other end, which stands
  EXPECT_EQ(base_along(problem, 0, Dof::u1).other, nullptr);
  EXPECT_EQ(BaseMotion<2>(problem, Constraints<2>(problem), 0).velocity(0.004).maxCoeff(), 0.0);
  problem.prescribed.back().value = problem.prescribed[2].value;
  ASSERT_NE(base_along(problem, 0, Dof::u1).item, nullptr);
  EXPECT_EQ(base_along(problem, 0, Dof::u1).other, nullptr);
  const BaseMotion<2> base(problem, Constraints<2>(problem), 0);
  EXPECT_DOUBLE_EQ(base.velocity(0.004).maxCoeff(), 1e-4 / 0.01);
  EXPECT_EQ(base.velocity(0.02).maxCoeff(), 0.0);  // it stands behind its table
}

TEST(dynamics, goes_on_from_an_archive_to_the_same_bits) {
  const auto problem = [] {
    Problem<2> made = bar(0.01, 0.01);
    made.quiet = {"right"};
    return made;
  };
  Solver<2> through(problem(), {});
  ASSERT_TRUE(through.begin_real_time().converged);
  for (const double broken : {0.0, 0.03}) {
    Solver<2> first(problem(), {});
    ASSERT_TRUE(first.begin_real_time().converged);
    if (broken > 0.0) {
      ASSERT_TRUE(first.advance_real_time(broken).converged);
    }
    MemoryArchive archive;
    first.save(archive);
    const StepReport expected = first.advance_real_time(0.08);
    Solver<2> again(problem(), {});
    again.restore(archive);
    const StepReport report = again.advance_real_time(0.08);
    EXPECT_EQ(again.state().displacement, first.state().displacement);
    EXPECT_EQ(again.state().velocity, first.state().velocity);
    EXPECT_EQ(report.energies.absorbed, expected.energies.absorbed);
    EXPECT_EQ(report.energies.external, expected.energies.external);
  }
}

// Steps of 1 s take the values at their ends. Triangles: half as long as a step, with their peak at its end, they count double;
// within a step, nothing is seen of them; of ten steps, the three kinks miss 1/8 of a step's change of slope.
TEST(TimeTables, TellWhatStepsMissOfThem) {
  EXPECT_NEAR(TimeTable({{4.75, 0.0}, {5.0, 1.0}, {5.25, 0.0}}).share_missed_by_steps(1.0, 9.0), 3.0, 1e-12);
  EXPECT_NEAR(TimeTable({{4.25, 0.0}, {4.5, 1.0}, {4.75, 0.0}}).share_missed_by_steps(1.0, 9.0), 1.0, 1e-12);
  EXPECT_NEAR(TimeTable({{0.0, 1.0}, {0.5, 0.0}}).share_missed_by_steps(1.0, 9.0), 1.0, 1e-12);
  EXPECT_LT(TimeTable({{3.3, 0.0}, {8.3, 1.0}, {13.3, 0.0}}).share_missed_by_steps(1.0, 20.0), 0.03);
  EXPECT_LT(TimeTable({{0.0, 0.0}, {1e-6, 1.0}}).share_missed_by_steps(1.0, 20.0), 0.03);  // a sudden load
  EXPECT_EQ(TimeTable::constant(2.0).share_missed_by_steps(1.0, 9.0), 0.0);
  EXPECT_EQ(TimeTable::ramp(2.0).share_missed_by_steps(1.0, 9.0), 0.0);
}

}  // namespace
}  // namespace polargrain::testing::real_time
