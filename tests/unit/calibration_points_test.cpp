// SPDX-License-Identifier: GPL-2.0-or-later
// The values of curves that a calibration compares, from rows that are known.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/calibrate/calibration.hpp"
#include "app/calibrate/doubts_of_curves.hpp"

namespace polargrain::app {
namespace {

using Rows = std::vector<std::vector<double>>;
const std::vector<std::string> kColumns{"stage", "row", "s22_Pa"};

Rows rows_of_stress(const std::vector<double>& stresses) {
  Rows rows;
  for (std::size_t k = 0; k < stresses.size(); ++k)
    rows.push_back({1.0, static_cast<double>(k), stresses[k]});
  return rows;
}

Calibration with_largest(double value, const Rows& rows) {
  TargetPoint point;
  point.column = "s22_Pa";
  point.where = TargetPoint::Where::largest;
  point.value = value;
  point.end_row = static_cast<int>(rows.size()) - 1;
  Calibration calibration;
  calibration.test_names = {"drained"};
  calibration.points = {point};
  return calibration;
}

double largest_of(double target, const Rows& rows) {
  return value_of(with_largest(target, rows).points.front(), kColumns, rows).value_or(0.0);
}

bool warns_of_last_row(double target, const Rows& rows) {
  return !doubts_of_curves(with_largest(target, rows), {kColumns}, {{rows}}).empty();
}

// Stresses are tension positive: the peak of a compression is the most negative value, not the start.
TEST(CalibrationPoints, ANegativeLargestValueIsTheMirrorOfAPositiveOne) {
  const std::vector<double> compression{-99.92e3, -222e3, -300e3, -250e3};
  std::vector<double> mirrored;
  for (const double stress : compression) mirrored.push_back(-stress);
  EXPECT_EQ(largest_of(-222e3, rows_of_stress(compression)), -300e3);
  EXPECT_EQ(largest_of(222e3, rows_of_stress(mirrored)), 300e3);
  EXPECT_EQ(largest_of(100.0, rows_of_stress(compression)), -99.92e3);
}

TEST(CalibrationPoints, AWarningOfTheLastRowIsOfTheSideOfTheTarget) {
  const Rows rising = rows_of_stress({-100e3, -200e3, -222e3});
  const Rows passes_zero =
      rows_of_stress({-100e3, 50e3, 200e3});  // of the largest magnitude, and not most negative
  const Rows peak = rows_of_stress({-100e3, -222e3, -200e3});
  EXPECT_TRUE(warns_of_last_row(-222e3, rising));
  EXPECT_FALSE(warns_of_last_row(-222e3, passes_zero));
  EXPECT_FALSE(warns_of_last_row(-222e3, peak));
  EXPECT_FALSE(warns_of_last_row(222e3, rising));
}

}  // namespace
}  // namespace polargrain::app
