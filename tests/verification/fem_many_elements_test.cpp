// SPDX-License-Identifier: GPL-2.0-or-later
// One of the hard cases at full size: 50,086 elements, some 450,000 unknowns.
#include "tests/verification/fem_block.hpp"

using namespace polargrain::fem;

namespace {

TEST(many_elements, end_at_the_exact_stress) {
  check_block({.name = "50,086 elements", .elements = {158, 317}});
}

}  // namespace
