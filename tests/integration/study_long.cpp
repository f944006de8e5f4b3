// SPDX-License-Identifier: GPL-2.0-or-later
// The reduced biaxial study: three specimens of 800 grains with and without rolling resistance, and two
// scales.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>

#include "tests/integration/study_run.hpp"

namespace {

using namespace polargrain::testing;

std::vector<std::string> words(const std::string& line) {
  std::vector<std::string> found;
  std::istringstream text(line);
  for (std::string word; std::getline(text, word, ',');) found.push_back(word);
  return found;
}

/// Columns of table.csv that hold numbers, by run and name.
std::map<std::string, std::map<std::string, double>> table(const std::filesystem::path& file) {
  std::map<std::string, std::map<std::string, double>> rows;
  std::istringstream text(content(file));
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> names = words(line);
  while (std::getline(text, line)) {
    const std::vector<std::string> values = words(line);
    for (std::size_t i = 2; i < std::min(names.size(), values.size()); ++i) {
      char* end = nullptr;
      const double value = std::strtod(values[i].c_str(), &end);
      if (end != values[i].c_str()) rows[values[0]][names[i]] = value;
    }
  }
  return rows;
}

TEST(Study, TwoScalesPeakAndLocaliseAsSpecimensOfGrainsDo) {
  const Scratch scratch("study_long");
  const Outcome outcome = run_in(scratch.path(), study("--jobs 2 -w 1"));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  std::cout << content(scratch.path() / "out/table.md");
  auto rows = table(scratch.path() / "out/table.csv");
  struct Comparison {
    std::string two_scales;
    std::string law;
    double most;  ///< peak over that of the grains
  };
  // Aimed at: 10 %. With rolling resistance a specimen falls short of its own packing taken as a cell by 16
  // %, for it deforms unevenly from the start, at platens and membranes; and cells of 400 grains scatter by 6
  // % (docs/studies/biaxial.md).
  for (const Comparison& compared : {Comparison{"informed-4x8-lc15", "", 1.16 * 1.06},
                                     Comparison{"informed-2x4-lc15-sliding", "-sliding", 1.10}}) {
    double peak = 0.0;
    double at_one_percent = 0.0;
    for (const std::string seed : {"1", "2", "3"}) {
      const auto& grains = rows.at("grains-800-seed" + seed + compared.law);
      peak += grains.at("peak") / 3.0;
      at_one_percent += grains.at("ratio_1%") / 3.0;
    }
    const auto& row = rows.at(compared.two_scales);
    std::cout << "[figure] " << compared.two_scales << ": peak " << row.at("peak") << ", grains " << peak
              << " (" << 100.0 * (row.at("peak") / peak - 1.0) << " %)\n";
    EXPECT_GT(row.at("peak") / peak, 0.9);
    EXPECT_LT(row.at("peak") / peak, compared.most);
    EXPECT_NEAR(row.at("ratio_1%") / at_one_percent, 1.0, 0.1);  // nothing localises yet
  }
  // The band of the two scales within 6 degrees of the mean of the specimens that have one.
  double inclination = 0.0;
  int bands = 0;
  for (const std::string seed : {"1", "2", "3"}) {
    const auto& grains = rows.at("grains-800-seed" + seed);
    if (grains.count("inclination_degrees") == 0) continue;
    inclination += std::abs(grains.at("inclination_degrees"));
    ++bands;
  }
  ASSERT_GE(bands, 2);
  inclination /= bands;
  const double found = std::abs(rows.at("informed-4x8-lc15").at("inclination_degrees"));
  std::cout << "[figure] inclination: two scales " << found << ", grains " << inclination << " degrees\n";
  EXPECT_NEAR(found, inclination, 6.0);
}

}  // namespace
