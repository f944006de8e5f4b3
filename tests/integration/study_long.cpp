// SPDX-License-Identifier: GPL-2.0-or-later
// The reduced biaxial study: three specimens of 800 grains with and without rolling resistance, and two
// scales on 2 x 4 elements.
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

TEST(Study, TwoScalesPeakAsSpecimensOfGrainsDo) {
  const Scratch scratch("study_long");
  const Outcome outcome = run_in(scratch.path(), study("--jobs 2 -w 1"));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  std::cout << content(scratch.path() / "out/table.md");
  auto rows = table(scratch.path() / "out/table.csv");
  for (const std::string law : {"", "-sliding"}) {
    double peak = 0.0;
    for (const std::string seed : {"1", "2", "3"})
      peak += rows.at("grains-800-seed" + seed + law).at("peak") / 3.0;
    const double two_scales = rows.at("informed-2x4-lc15" + law).at("peak");
    std::cout << "[figure] peak" << law << ": grains " << peak << ", two scales " << two_scales << " ("
              << 100.0 * (two_scales / peak - 1.0) << " %)\n";
    // What was aimed at is 10 %. Specimens of 800 grains with rolling resistance fall short of their own
    // packing taken as a cell by 16 %: they deform unevenly from the start, at platens and membranes
    // (docs/studies/biaxial.md). To that comes the scatter of three packings, 2 %.
    EXPECT_GT(two_scales / peak, 0.9);
    EXPECT_LT(two_scales / peak, law.empty() ? 1.2 : 1.1);
    // Up to 1 % nothing localises: the curves agree within the scatter of packings.
    EXPECT_NEAR(
        rows.at("informed-2x4-lc15" + law).at("ratio_1%") / rows.at("grains-800-seed1" + law).at("ratio_1%"),
        1.0, 0.12);
  }
  // Inclinations are those of grains only: elements of 100 mm cannot resolve a band of 50 mm. Every band that
  // is found lies where Mohr-Coulomb theory allows it, between the zero-extension and the stress direction:
  // 45 to 68 degrees for a friction angle up to 42 degrees, and 10 degrees of scatter of a specimen 20 grains
  // wide.
  for (const auto& [name, row] : rows)
    if (row.count("inclination_degrees") > 0) {
      EXPECT_GT(std::abs(row.at("inclination_degrees")), 35.0) << name;
      EXPECT_LT(std::abs(row.at("inclination_degrees")), 70.0) << name;
    }
}

}  // namespace
