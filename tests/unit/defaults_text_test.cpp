// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/defaults_text.hpp"

#include <gtest/gtest.h>

namespace polargrain::app {
namespace {

TEST(DefaultsText, HasALineForEachSectionInTheOrderOfTheirFirstKeys) {
  const std::vector<coupler::KeyLeft> left = {
      {"steps", "cut", "6"}, {"output", "points", "yes"}, {"steps", "iterations", "30"}};
  EXPECT_EQ(lines_of_defaults(left), (std::vector<std::string>{"not given in steps: cut 6, iterations 30",
                                                               "not given in output: points yes"}));
  EXPECT_TRUE(lines_of_defaults({}).empty());
}

}  // namespace
}  // namespace polargrain::app
