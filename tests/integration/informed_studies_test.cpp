// SPDX-License-Identifier: GPL-2.0-or-later
// The commands of the studies at their smallest, with real grains.
#include <gtest/gtest.h>

#include <algorithm>
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

TEST(Studies, TheCalibrationKeepsARecordAndTheSpecimenUsesIt) {
  if (std::system("/usr/bin/python3 -c 'import scipy' 2>/dev/null") != 0) {
    GTEST_SKIP() << "python3-scipy is not installed; ./bootstrap installs it";
  }
  const Scratch scratch("Calibration");
  const auto script = [&](const std::string& name, const std::string& options) {
    return run_in(scratch.path(), "/usr/bin/python3 " + (kSource / "cases/studies/toyoura" / name).string() +
                                      " -o out --jobs 2 --program " POLARGRAIN
                                      " --liggghts " POLARGRAIN_LIGGGHTS " " +
                                      options);
  };
  const std::string reduced = "--grains 40 --packings 2 --starts 1 --evaluations ";
  const Outcome first = script("calibrate.py", reduced + "1 --no-predictions");
  ASSERT_EQ(first.status, 0) << first.errors;
  // A point and its three neighbours, behind the header.
  const std::string record = content(scratch.path() / "out/record.csv");
  EXPECT_EQ(std::count(record.begin(), record.end(), '\n'), 5) << record;
  const Outcome second = script("calibrate.py", reduced + "2");
  ASSERT_EQ(second.status, 0) << second.errors;
  const std::string longer = content(scratch.path() / "out/record.csv");
  EXPECT_EQ(longer.substr(0, record.size()), record);
  EXPECT_EQ(std::count(longer.begin(), longer.end(), '\n'), 9) << longer;
  EXPECT_NE(content(scratch.path() / "out/best.txt").find("evaluations = 8"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "out/prediction-98kPa-seed2.csv"));

  const Outcome specimen = script("specimen.py", "--sizes 6:2 --strain 0.6");
  ASSERT_EQ(specimen.status, 0) << specimen.errors;
  const std::string figures = content(scratch.path() / "out/specimen.csv");
  EXPECT_EQ(std::count(figures.begin(), figures.end(), '\n'), 3) << figures;
  EXPECT_NEAR(CsvTable(scratch.path() / "out/specimen-98-6-2/out/history.csv").numbers("axial_strain").back(),
              0.006, 1e-9);
  EXPECT_GT(CsvTable(scratch.path() / "out/specimen-98-6-2/out/history.csv").numbers("stress_ratio").back(),
            2.0);
}

}  // namespace
}  // namespace polargrain::testing
