// SPDX-License-Identifier: GPL-2.0-or-later
// A softening column whose slips are spread, in explicit steps, against its closed form.
#include "tests/support/spread_explicit_column.hpp"

namespace polargrain::testing::spread_column {
namespace {

TEST(spread_explicit, column_has_the_thickness_and_the_stress_of_the_closed_form) {
  for (Law (*const law)(const ElastoplasticParameters<2>&) : {cone, answers_of}) {
    Solver<2> solver(column_of(law), {});
    ASSERT_TRUE(solver.begin_explicit().converged);
    for (int row = 0; row < 5; ++row) {
      const StepReport report = row_of(solver, row);
      ASSERT_TRUE(report.converged) << row << " " << report.message;
      if (row < 2) continue;  // elastic, and the onset
      const ClosedForm exact = ClosedForm::at(displacement_of(row + 1), true);
      // Waves of the speed of the plate are 0.4 % of the peak in the last row.
      EXPECT_NEAR(solver.reaction("top")(0) / (kHeight / kElements), exact.stress(), 0.005 * kPeak) << row;
      EXPECT_NEAR(width_of(solver), exact.width(), 0.05 * exact.width()) << row;
    }
  }
}

}  // namespace
}  // namespace polargrain::testing::spread_column
