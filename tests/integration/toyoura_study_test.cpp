// SPDX-License-Identifier: GPL-2.0-or-later
// Study 2 at its smallest, with real grains.
#include <gtest/gtest.h>

#include <algorithm>

#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::filesystem::path kSource = POLARGRAIN_SOURCE_DIRECTORY;

TEST(ToyouraStudy, SandIsCalibratedAndPredictedByOneCommandThatGoesOn) {
  const Scratch scratch("Toyoura");
  const std::string command = "/usr/bin/python3 " + (kSource / "cases/studies/toyoura/study.py").string() +
                              " -o out --program " POLARGRAIN
                              " --grains 50 --seeds 2 --evaluations 3 --strain 0.6 --tests ";
  const Outcome first = run_in(scratch.path(), command + "1");
  ASSERT_EQ(first.status, 0) << first.errors;
  const std::filesystem::path out = scratch.path() / "out";
  const std::string record = content(out / "spheres/record.csv");
  EXPECT_GE(std::count(record.begin(), record.end(), '\n'), 2 + 3) << record;
  const CsvTable fitted(out / "spheres/tests/TATS86-16a-seed2.csv");
  EXPECT_NEAR(fitted.numbers("axial_strain").back(), 0.006, 1e-9);
  EXPECT_GT(fitted.numbers("stress_ratio").back(), 2.0);
  EXPECT_NE(first.out.find("| TATS86-16a | 1 |"), std::string::npos) << first.out;

  const auto time = std::filesystem::last_write_time(out / "spheres/tests/TATS86-16a-seed2.csv");
  const Outcome second = run_in(scratch.path(), command + "3");
  ASSERT_EQ(second.status, 0) << second.errors;
  EXPECT_EQ(content(out / "spheres/record.csv"), record);
  EXPECT_EQ(std::filesystem::last_write_time(out / "spheres/tests/TATS86-16a-seed2.csv"), time);
  // A looser or denser packing of the same grains, at the pressure of the row.
  const CsvTable predicted(out / "spheres/tests/peak-4.9-0.672-seed2.csv");
  EXPECT_NEAR(predicted.numbers("void_ratio").front(), 0.672, 0.06);
  EXPECT_NEAR(predicted.numbers("s11_Pa").back() / -4.9e3, 1.0, 0.02);
  EXPECT_NE(second.out.find("| 4.9 | 0.672 | 1 | 49.9 |"), std::string::npos) << second.out;

  // A specimen of such cells, as far as 0.2 %.
  const Outcome third =
      run_in(scratch.path(), "/usr/bin/python3 " + (kSource / "cases/studies/toyoura/specimens.py").string() +
                                 " -o out --program " POLARGRAIN
                                 " --grains 50 --strain 0.2 --only 49kPa-4x8-lc2-seed2");
  ASSERT_EQ(third.status, 0) << third.errors;
  EXPECT_NE(third.out.find("| 49kPa-4x8-lc2 | 1 |"), std::string::npos) << third.out;
  const CsvTable history(out / "spheres/specimens/49kPa-4x8-lc2-seed2/history.csv");
  EXPECT_NEAR(history.numbers("axial_strain").back(), 0.002, 1e-9);
  EXPECT_LT(history.numbers("top_force").back(), -1.2 * 0.09 * 49e3);
}

}  // namespace
}  // namespace polargrain::testing
