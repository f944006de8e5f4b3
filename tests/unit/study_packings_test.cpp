// SPDX-License-Identifier: GPL-2.0-or-later
// Packings that the studies start from are at rest and isotropic, as docs/user_guide.md says of what `pack` makes.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iostream>

#include "common/packing_file.hpp"

namespace polargrain {
namespace {

TEST(StudyPackings, CarryTheirPressureInAllDirectionsAndNoShearStress) {
  constexpr double kIsotropic = 1e-3;  // of the pressure
  int seen = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(POLARGRAIN_SOURCE_DIRECTORY "/cases/studies")) {
    if (entry.path().extension() != ".h5") continue;
    const PackingReached reached = read_packing_file(entry.path()).reached;
    std::cout << "[figure] " << entry.path().filename().string() << ": anisotropy " << reached.anisotropy
              << ", shear " << reached.shear << ", unbalanced " << reached.unbalanced_force_ratio << '\n';
    EXPECT_LE(std::abs(reached.anisotropy), kIsotropic) << entry.path();
    EXPECT_LE(std::abs(reached.shear), kIsotropic) << entry.path();
    EXPECT_LE(reached.unbalanced_force_ratio, kIsotropic) << entry.path();
    ++seen;
  }
  EXPECT_EQ(seen, 4);
}

}  // namespace
}  // namespace polargrain
