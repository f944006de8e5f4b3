// SPDX-License-Identifier: GPL-2.0-or-later
// The reduced biaxial study: three specimens of 800 grains with and without rolling resistance, and two
// scales.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <optional>

#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"
#include "tests/integration/study_run.hpp"

namespace {

using namespace polargrain::testing;

/// table.csv: the numbers of each run.
class Table {
 public:
  explicit Table(const std::filesystem::path& file) : csv_(file) {}
  /// Nothing when the cell is empty: no band.
  [[nodiscard]] std::optional<double> find(const std::string& run, const std::string& name) const {
    for (std::size_t row = 0; row < csv_.rows(); ++row)
      if (csv_.cell(row, "run") == run) {
        const std::string& cell = csv_.cell(row, name);
        return cell.empty() ? std::nullopt : std::optional(std::stod(cell));
      }
    throw std::runtime_error("no run " + run);
  }
  [[nodiscard]] double at(const std::string& run, const std::string& name) const {
    return find(run, name).value();
  }

 private:
  polargrain::CsvTable csv_;
};

TEST(Study, TwoScalesPeakAndLocaliseAsSpecimensOfGrainsDo) {
  const Scratch scratch("study_long");
  const Outcome outcome = run_in(scratch.path(), study("--jobs 2 -w 1"));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  std::cout << content(scratch.path() / "out/table.md");
  const Table table(scratch.path() / "out/table.csv");
  struct Comparison {
    std::string two_scales;
    std::string law;
    double most;  ///< peak over that of the grains
  };
  // Aimed at: 10 %. With rolling resistance a specimen falls short of its own packing taken as a cell by 16
  // %, for it deforms unevenly from the start, at platens and membranes; cells of 400 grains scatter by 6 %,
  // the mean of three specimens by 6 % (docs/studies/biaxial.md).
  for (const Comparison& compared : {Comparison{"informed-4x8-lc15", "", 1.16 * 1.085},
                                     Comparison{"informed-2x4-lc15-sliding", "-sliding", 1.10}}) {
    double peak = 0.0;
    double at_one_percent = 0.0;
    for (const std::string seed : {"1", "2", "3"}) {
      const std::string grains = "grains-800-seed" + seed + compared.law;
      peak += table.at(grains, "peak") / 3.0;
      at_one_percent += table.at(grains, "ratio_1%") / 3.0;
    }
    const double found = table.at(compared.two_scales, "peak");
    std::cout << "[figure] " << compared.two_scales << ": peak " << found << ", grains " << peak << " ("
              << 100.0 * (found / peak - 1.0) << " %)\n";
    EXPECT_GT(found / peak, 0.9);
    EXPECT_LT(found / peak, compared.most);
    EXPECT_NEAR(table.at(compared.two_scales, "ratio_1%") / at_one_percent, 1.0,
                0.1);  // nothing localises yet
  }
  // The band of the two scales beside the mean of the specimens that have one (others fail in a wedge at a
  // platen). Inclinations of ten specimens of 800 grains, of several versions: 39.9 to 64.1, standard
  // deviation 7.1 degrees.
  double inclination = 0.0;
  int bands = 0;
  for (const std::string seed : {"1", "2", "3"}) {
    if (const auto own = table.find("grains-800-seed" + seed, "inclination_degrees")) {
      inclination += std::abs(*own);
      ++bands;
    }
  }
  ASSERT_GE(bands, 2);
  inclination /= bands;
  const double found = std::abs(table.at("informed-4x8-lc15", "inclination_degrees"));
  std::cout << "[figure] inclination: two scales " << found << ", grains " << inclination << " degrees\n";
  EXPECT_NEAR(found, inclination, 2.0 * 7.1 / std::sqrt(bands));  // 95 %
}

}  // namespace
