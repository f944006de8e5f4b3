// SPDX-License-Identifier: GPL-2.0-or-later
// The command of the biaxial study at its reduced size: its tables, going on, and runs that fail. What the page says is held in
// study_long.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/csv_table.hpp"
#include "tests/integration/study_run.hpp"

namespace {

using namespace polargrain::testing;

TEST(StudyCommand, GoesOnWhereItWasBrokenOffWithTheSameBytes) {
  const Scratch scratch("study_resumed");
  const std::string small = study("--only informed-2x4-cells100-pair1 --strain 0.01 -w 2");
  std::filesystem::create_directories(scratch.path() / "whole");
  const Outcome whole = run_in(scratch.path() / "whole", small);
  ASSERT_EQ(whole.status, 0) << whole.out << whole.errors;

  // A time limit, as soon as there is something to go on from: nine steps follow.
  Outcome stopped;
  // A busy machine may see to the end of these before the signal comes: then once more.
  for (int attempt = 0; attempt < 5 && stopped.status != 3; ++attempt) {
    std::filesystem::remove_all(scratch.path() / "out");
    stopped = run_in(scratch.path(), "{ " + small +
                                         " & until [ -e out/informed-2x4-cells100-pair1/checkpoint.h5 ] || "
                                         "! kill -0 $!; do sleep 0.02; done; kill -TERM $!; wait $!; }");
  }
  EXPECT_EQ(stopped.status, 3) << stopped.out << stopped.errors;
  EXPECT_NE(stopped.errors.find("the same command goes on"), std::string::npos) << stopped.errors;
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "out/table.md"));

  // The results may lie elsewhere by then.
  std::filesystem::create_directories(scratch.path() / "moved");
  std::filesystem::rename(scratch.path() / "out", scratch.path() / "moved/out");
  const Outcome rest = run_in(scratch.path() / "moved", small);
  ASSERT_EQ(rest.status, 0) << rest.out << rest.errors;
  const std::string log = content(scratch.path() / "moved/out/informed-2x4-cells100-pair1.log");
  EXPECT_NE(log.find("going on behind step"), std::string::npos) << log;
  for (const char* file :
       {"out/informed-2x4-cells100-pair1/history.csv", "out/informed-2x4-cells100-pair1/band.json",
        "out/informed-2x4-cells100-pair1.samples.csv"}) {
    EXPECT_FALSE(content(scratch.path() / "whole" / file).empty()) << file;
    EXPECT_EQ(content(scratch.path() / "whole" / file), content(scratch.path() / "moved" / file)) << file;
  }
  EXPECT_NE(content(scratch.path() / "moved/out/table.md").find("| informed-2x4-cells100 | 1 |"),
            std::string::npos);
}

TEST(StudyCommand, NamesARunThatFailsWithItsLogAndCarriesOutTheOthers) {
  const Scratch scratch("study_broken");
  std::filesystem::create_directories(scratch.path() / "out/packings");
  write(scratch.path() / "out/packings/1600-seed1.h5", "no packing");
  const Outcome outcome = run_in(scratch.path(), study("--only grains-800-seed1,law-8x16-lc3 --jobs 1"));
  EXPECT_EQ(outcome.status, 1) << outcome.out;
  EXPECT_NE(outcome.errors.find("1 of 2 runs failed"), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.errors.find("grains-800-seed1: specimen.py ended with status 1; the end of "
                                "out/grains-800-seed1.log"),
            std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("1600-seed1.h5"), std::string::npos) << outcome.errors;
  const std::string table = content(scratch.path() / "out/table.md");
  EXPECT_EQ(table.find("grains-800"), std::string::npos) << table;
  // The peak of docs/studies/biaxial_two_scale.md.
  EXPECT_NE(table.find("| law-8x16-lc3 | 4.2494 | 1.9 |"), std::string::npos) << table;
}

TEST(StudyCommand, KnowsItsRuns) {
  const Scratch scratch("study_names");
  const Outcome unknown = run_in(scratch.path(), study("--only nothing"));
  EXPECT_EQ(unknown.status, 1);
  EXPECT_NE(unknown.errors.find("no run is called nothing"), std::string::npos) << unknown.errors;
  const Outcome list = run_in(scratch.path(), study("--size full --list"));
  EXPECT_EQ(list.status, 0) << list.errors;
  for (const char* last :
       {"grains-800-seed30\n", "grains-5000-seed10\n", "grains-20000-seed3\n", "element-1600-seed30\n",
        "controlled-16x32-pair10\n", "fixed_point-8x16-pair10\n", "informed-8x16-mirrored-pair10\n"})
    EXPECT_NE(list.out.find(last), std::string::npos) << last;
}

/// A column of table.csv, of the runs whose names begin so; in the order of the table.
std::vector<double> of_runs(const polargrain::CsvTable& table, const std::string& begin,
                            const std::string& column) {
  std::vector<double> values;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (table.cell(row, "run").starts_with(begin)) values.push_back(std::stod(table.cell(row, column)));
  return values;
}

/// Mean and 95 % interval of two values: Student's t of one degree of freedom is 12.706, their standard error half of
/// their difference.
std::string mean_of(const std::vector<double>& two) {
  return fmt::format("{:.3g} +- {:.2g}", (two[0] + two[1]) / 2.0, 12.706 * std::abs(two[0] - two[1]) / 2.0);
}

TEST(StudyCommand, TablesAreTheMeansOfItsRuns) {
  const Scratch scratch("study_reduced");
  const Outcome outcome = run_in(scratch.path(), study("-w 2"));
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.errors;
  const std::string text = content(scratch.path() / "out/table.md");
  const polargrain::CsvTable table(scratch.path() / "out/table.csv");
  const std::vector<double> small = of_runs(table, "grains-50-", "peak");
  const std::vector<double> large = of_runs(table, "grains-100-", "peak");
  const std::vector<double> cells = of_runs(table, "element-200-", "peak");
  for (const auto* two : {&small, &large, &cells}) ASSERT_EQ(two->size(), 2U) << text;

  const std::vector<double> ratios =
      polargrain::CsvTable(scratch.path() / "out/grains-50-seed1/history.csv").numbers("stress_ratio");
  EXPECT_DOUBLE_EQ(small[0], *std::max_element(ratios.begin(), ratios.end()));
  EXPECT_NE(text.find(mean_of(small)), std::string::npos) << mean_of(small) << '\n' << text;
  EXPECT_NE(text.find(mean_of(cells)), std::string::npos) << mean_of(cells) << '\n' << text;
  // A specimen of 100 grains is compared with the cell of 200 that it is cut from.
  const std::string fall =
      mean_of({100.0 * (large[0] / cells[0] - 1.0), 100.0 * (large[1] / cells[1] - 1.0)});
  EXPECT_NE(text.find(fall), std::string::npos) << fall << '\n' << text;
  // Two sizes whose widths are as 1 : sqrt(2): the line goes through both means.
  const double wide = (large[0] + large[1]) / 2.0;
  const double narrow = (small[0] + small[1]) / 2.0;
  const std::string beyond = fmt::format("peak: {:.3g} +- ", wide + (wide - narrow) / (std::sqrt(2.0) - 1.0));
  EXPECT_NE(text.find(beyond), std::string::npos) << beyond << '\n' << text;
  EXPECT_NE(text.find("| informed-2x4-cells100 | 2 |"), std::string::npos) << text;
}

}  // namespace
