// SPDX-License-Identifier: GPL-2.0-or-later
// The commands of the studies at their smallest, with real grains.
#include <gtest/gtest.h>

#include <iostream>

#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::filesystem::path kSource = POLARGRAIN_SOURCE_DIRECTORY;

TEST(Studies, BothSchemesOfTheBiaxialStudyAgreeInTheirFirstPercent) {
  const Scratch scratch("Studies");
  double ratio[2] = {0.0, 0.0};
  const char* const schemes[2] = {"informed", "cell"};
  for (int i : {0, 1}) {
    const std::string scheme = schemes[i];
    const Outcome outcome =
        run_in(scratch.path(), std::string(POLARGRAIN) + " run " +
                                   (kSource / ("cases/studies/biaxial_" + scheme + ".yaml")).string() +
                                   " -o " + scheme +
                                   " -w 2 --quiet --set 'mesh.rectangle.elements=[1, 2]'"
                                   " --set 'mesh.rectangle.patch=[0.15 m, 0.15 m]'"
                                   " --set boundary.2.move.u2='-3.2 mm' --set steps.count=8");
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
    ratio[i] = CsvTable(scratch.path() / scheme / "history.csv").numbers("stress_ratio").back();
  }
  std::cout << "[figure] stress ratio at 0.8 %: informed " << ratio[0] << ", cell " << ratio[1] << '\n';
  EXPECT_GT(ratio[1], 2.5);
  // On the steep start the frozen scheme is a step of 0.1 % behind, which is a tenth of the rise.
  EXPECT_NEAR(ratio[0] / ratio[1], 1.0, 0.1);
}

TEST(Studies, ACaseOfAThousandSpheresAPointRunsInBothSchemes) {
  const Scratch scratch("Studies_spheres");
  double ratio[2] = {0.0, 0.0};
  const char* const schemes[2] = {"informed", "cell"};
  for (int i : {0, 1}) {
    const std::string scheme = schemes[i];
    const Outcome outcome =
        run_in(scratch.path(),
               std::string(POLARGRAIN) + " run " + (kSource / "cases/studies/spheres_512.yaml").string() +
                   " -o " + scheme + " -w 2 --quiet --set materials.sand.model=" + scheme +
                   " --set 'mesh.rectangle.elements=[1, 1]' --set 'mesh.rectangle.size=[0.4 m, 0.4 m]'"
                   " --set boundary.1.move.u2='-2 mm' --set steps.count=5");
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
    ratio[i] = CsvTable(scratch.path() / scheme / "history.csv").numbers("stress_ratio").back();
  }
  std::cout << "[figure] stress ratio at 0.5 %: informed " << ratio[0] << ", cell " << ratio[1] << '\n';
  EXPECT_GT(ratio[1], 4.0);
  // As above.
  EXPECT_NEAR(ratio[0] / ratio[1], 1.0, 0.1);
}

}  // namespace
}  // namespace polargrain::testing
