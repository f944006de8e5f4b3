// SPDX-License-Identifier: GPL-2.0-or-later
// The reduced specimen of the biaxial study: 800 discs to 8 % of strain, two minutes alone on a core.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/integration/specimen_run.hpp"

namespace {

using namespace polargrain::testing;

TEST(Specimen, PeaksAsInTheStudy) {
  const Scratch scratch("specimen_long");
  const Outcome run = run_specimen(scratch.path(), "-o run --rate 0.72 --strain 0.08");
  ASSERT_EQ(run.status, 0) << run.out << run.errors;
  const polargrain::CsvTable history(scratch.path() / "run/history.csv");
  const std::vector<double> ratios = history.numbers("stress_ratio");
  const auto highest = std::max_element(ratios.begin(), ratios.end());
  const double peak = *highest;
  const double strain = history.numbers("axial_strain")[static_cast<std::size_t>(highest - ratios.begin())];
  std::cout << "[figure] 800 discs: peak stress ratio " << peak << " at an axial strain of " << strain
            << "\n";
  // Packings at a third of this rate: 3.7 at 0.03 (docs/studies/biaxial.md), this one 3.59 at 0.017.
  EXPECT_NEAR(peak, 3.7, 0.10 * 3.7);
  EXPECT_NEAR(strain, 0.03, 0.02);

  const Outcome band = run_in(scratch.path(), std::string(POLARGRAIN) + " band run --from 0.04 --to 0.08");
  ASSERT_EQ(band.status, 0) << band.errors;
  std::cout << band.out;
  // Whether the band is straight and within the body differs from packing to packing: it is printed, not
  // asserted.
}

}  // namespace
