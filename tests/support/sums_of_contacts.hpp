// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <gtest/gtest.h>

#include "dem/box/contact_sums.hpp"

namespace polargrain::testing {

/// Resident boxes answer with sums, others from the list: both to the bit, whichever is asked first.
/// @param run run(box, steps) @tparam dim of the box
template <int dim, class Box, class Run>
void expect_sums_without_a_list(Box& box, const Run& run) {
  for (const int steps : {100, 120}) {
    run(box, steps);
    const dem::ContactSums<dim> sums = box.contact_sums();
    const dem::ContactSums<dim> listed = dem::sums_of<dim>(box.contacts());
    EXPECT_EQ(sums.virial, listed.virial);
    EXPECT_EQ(sums.forces, listed.forces);
    EXPECT_EQ(sums.contacts, static_cast<double>(box.contacts().size()));
    EXPECT_EQ(box.contact_sums().virial, listed.virial);
  }
}

}  // namespace polargrain::testing
