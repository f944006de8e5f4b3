// SPDX-License-Identifier: GPL-2.0-or-later
// The commands of the studies at their smallest, with real grains.
#include <gtest/gtest.h>

#include <iostream>

#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::filesystem::path kSource = POLARGRAIN_SOURCE_DIRECTORY;

/// The stress ratio at the end of a case of the studies, run with these settings.
double last_ratio(const Scratch& scratch, const std::string& name, const std::string& scheme,
                  const std::string& settings) {
  const Outcome outcome =
      run_in(scratch.path(), std::string(POLARGRAIN) + " run " + (kSource / "cases/studies" / name).string() +
                                 " -o " + scheme + " -w 2 --quiet " + settings);
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  return CsvTable(scratch.path() / scheme / "history.csv").numbers("stress_ratio").back();
}

TEST(Studies, BothSchemesOfTheBiaxialStudyAgreeInTheirFirstPercent) {
  const Scratch scratch("Studies");
  const auto ratio = [&](const std::string& scheme) {
    return last_ratio(scratch, "biaxial_" + scheme + ".yaml", scheme,
                      "--set 'mesh.rectangle.elements=[1, 2]' --set 'mesh.rectangle.patch=[0.15 m, 0.15 m]'"
                      " --set boundary.2.move.u2='-3.2 mm' --set steps.count=8");
  };
  const double informed = ratio("informed");
  const double cell = ratio("cell");
  std::cout << "[figure] stress ratio at 0.8 %: informed " << informed << ", cell " << cell << '\n';
  EXPECT_GT(cell, 2.5);
  // On the steep start the frozen scheme is a step of 0.1 % behind, which is a tenth of the rise.
  EXPECT_NEAR(informed / cell, 1.0, 0.1);
}

TEST(Studies, ACaseOfAThousandSpheresAPointRunsInBothSchemes) {
  const Scratch scratch("Studies_spheres");
  const auto ratio = [&](const std::string& scheme) {
    return last_ratio(scratch, "spheres_512.yaml", scheme,
                      "--set materials.sand.model=" + scheme +
                          " --set 'mesh.rectangle.elements=[1, 1]' --set 'mesh.rectangle.size=[0.4 m, 0.4 m]'"
                          " --set boundary.1.move.u2='-2 mm' --set steps.count=5");
  };
  const double informed = ratio("informed");
  const double cell = ratio("cell");
  std::cout << "[figure] stress ratio at 0.5 %: informed " << informed << ", cell " << cell << '\n';
  EXPECT_GT(cell, 4.0);
  // As above.
  EXPECT_NEAR(informed / cell, 1.0, 0.1);
}

}  // namespace
}  // namespace polargrain::testing
