// SPDX-License-Identifier: GPL-2.0-or-later
// A further field at nodes through the public interface alone: heat conduction, uncoupled, against its exact solution.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "common/error.hpp"
#include "common/memory_archive.hpp"
#include "tests/support/heat_conduction.hpp"

namespace polargrain::testing::heat {
namespace {

// Its order: nodal_field_order_test.
TEST(nodal_field, carries_heat_in_space) {
  EXPECT_LT(error_at_end<3>(2, "H8", 0.5, 4), 0.1);
}

TEST(nodal_field, leaves_the_displacements_as_they_are_without_it) {
  Problem<2> dry = cooling_bar<2>(4, "Q8R", 1.0);
  dry.fields.clear(), dry.prescribed_fields.clear(), dry.contributions.clear();
  Solver<2> without(std::move(dry), {});
  Solver<2> with(cooling_bar<2>(4, "Q8R", 1.0), {});
  for (Solver<2>* solver : {&without, &with}) {
    ASSERT_TRUE(solver->equilibrate().converged);
    ASSERT_TRUE(solver->advance(1.0).converged);
  }
  const Eigen::VectorXd& u = without.state().displacement;
  EXPECT_LT((with.state().displacement.head(u.size()) - u).norm(), 1e-13 * u.norm());
  EXPECT_NEAR(with.reaction("left")(0), without.reaction("left")(0), 1e-9 * 5e3);
}

TEST(nodal_field, heat_that_leaves_through_the_ends_is_what_the_bar_loses) {
  Solver<2> solver(cooling_bar<2>(4, "Q8R", 1.0), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  const auto stored = [&] {
    double sum = 0.0;
    for (const int node : solver.problem().fields[0].nodes)
      sum += kCapacity * 0.5 * kLength / 4 * 0.5 *
             solver.state().displacement(solver.problem().places().entry(0, node));
    return sum;  // trapezoids; zero at the ends
  };
  const double before = stored();
  ASSERT_TRUE(solver.advance(0.1 / kDecay).converged);
  EXPECT_NEAR(solver.field_reaction(0, {"left", "right"}), before - stored(), 1e-9 * before);
}

TEST(nodal_field, a_step_that_a_contribution_refuses_is_cut) {
  Solver<2> solver(cooling_bar<2>(4, "Q8R", 1.0, 0.3 / kDecay), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0 / kDecay);
  EXPECT_TRUE(report.converged) << report.message;
  EXPECT_GE(report.cuts, 2);
  EXPECT_GE(report.substeps, 4);
}

TEST(nodal_field, goes_on_from_an_archive_to_the_same_bits) {
  Solver<2> through(cooling_bar<2>(4, "Q8R", 1.0), {});
  ASSERT_TRUE(through.equilibrate().converged);
  ASSERT_TRUE(through.advance(0.1 / kDecay).converged);
  MemoryArchive archive;
  through.save(archive);
  Solver<2> restored(cooling_bar<2>(4, "Q8R", 1.0), {});
  restored.restore(archive);
  for (Solver<2>* solver : {&through, &restored}) ASSERT_TRUE(solver->advance(0.2 / kDecay).converged);
  EXPECT_EQ(through.state().displacement, restored.state().displacement);
  EXPECT_EQ(through.state().contributed, restored.state().contributed);
}

TEST(nodal_field, faults_and_refusals_name_it) {
  Problem<2> problem = cooling_bar<2>(2, "Q8R", 1.0);
  problem.prescribed_fields[1].value = TimeTable::constant(5.0);
  problem.prescribed_fields[1].on = "bottom";
  problem.prescribed_fields.push_back({"S", "left", TimeTable::constant(0.0)});
  const std::vector<std::string> messages = faults(problem);
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_NE(messages[0].find("'T' is given two different values at the node (0, 0)"), std::string::npos);
  EXPECT_NE(messages[1].find("no nodal field 'S'"), std::string::npos);

  Solver<2> solver(cooling_bar<2>(2, "Q8R", 1.0), {});
  EXPECT_THROW((void)solver.begin_explicit(), RunError);
  EXPECT_THROW((void)solver.advance_measure({{{1, Dof::u1, 1.0}}}, 1e-3), RunError);
}

}  // namespace
}  // namespace polargrain::testing::heat
