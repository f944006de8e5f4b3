// SPDX-License-Identifier: GPL-2.0-or-later
// Order of a nodal field in time and in space.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/heat_conduction.hpp"

namespace polargrain::testing::heat {
namespace {

TEST(nodal_field, heat_is_of_first_order_in_time_with_backward_steps_and_of_second_with_mean_ones) {
  const auto error = [](double theta, int steps) { return error_at_end<2>(64, "Q8R", theta, steps); };
  EXPECT_NEAR(error(1.0, 10) / error(1.0, 20), 2.0, 0.1);
  // 4 but for the error of 64 elements.
  EXPECT_NEAR(error(0.5, 2) / error(0.5, 4), 4.0, 0.1);
}

TEST(nodal_field, heat_is_of_second_order_in_space) {
  for (const char* type : {"Q8R", "Q4"})
    EXPECT_NEAR(error_at_end<2>(4, type, 0.5, 60) / error_at_end<2>(8, type, 0.5, 60), 4.0, 0.2) << type;
  EXPECT_NEAR(error_at_end<2>(8, "T6", 0.5, 60) / error_at_end<2>(16, "T6", 0.5, 60), 4.0, 0.4);
  for (const char* type : {"H20R", "H8"})
    EXPECT_NEAR(error_at_end<3>(4, type, 0.5, 60) / error_at_end<3>(8, type, 0.5, 60), 4.0, 0.2) << type;
}

}  // namespace
}  // namespace polargrain::testing::heat
