// SPDX-License-Identifier: GPL-2.0-or-later
// The command bench: its arithmetic on known curves, and the whole program over local and fake materials.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>
#include <sstream>

#include "app/bench/bench_page.hpp"
#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::app {
namespace {

using testing::content;
using testing::Outcome;
using testing::run_in;

TEST(BenchErrors, AreThoseOfKnownCurves) {
  const BenchCurve reference{{0.0, 1.0, 2.0}, {0.0, 10.0, 20.0}};
  const BenchCurve curve{{0.0, 0.5, 1.5, 2.0}, {0.0, 6.0, 15.0, 18.0}};
  // Largest differences: 1 at 0.5, 2 at the end; the range is 20. Peaks 18 and 20.
  const BenchError error = error_of(curve, reference);
  EXPECT_DOUBLE_EQ(error.largest, 0.1);
  EXPECT_DOUBLE_EQ(error.peak, 0.1);
  EXPECT_DOUBLE_EQ(reference.at(1.25), 12.5);
  // A run that goes further than the reference is compared as far as both go: to 20 at 2, halfway between the
  // run's 10 and 34.
  EXPECT_DOUBLE_EQ(error_of({{0.0, 1.0, 3.0}, {0.0, 10.0, 34.0}}, reference).largest, 0.1);
  EXPECT_DOUBLE_EQ(error_of({{0.0, 1.0, 3.0}, {0.0, 10.0, 34.0}}, reference).peak, 0.1);
  EXPECT_DOUBLE_EQ(error_of({{0.0, -1.0, -4.0}, {0.0, 10.0, 40.0}}, {{0.0, -2.0}, {0.0, 20.0}}).largest, 0.0);
  // A curve that goes both ways is compared on the reference's side: 18 with 20, not -25.
  EXPECT_DOUBLE_EQ(error_of({{0.0, 1.0, 2.0}, {0.0, -25.0, 18.0}}, reference).peak, 0.1);
  // Compression: x falls.
  EXPECT_DOUBLE_EQ(BenchCurve({{0.0, -1.0}, {0.0, 4.0}}).at(-0.5), 2.0);
}

// Loaded to 2 and back: by x alone, 40 on the way back to 1 would be compared with the 10 of the way there.
TEST(BenchErrors, OfACopyAreNoneWhereXGoesBack) {
  const BenchCurve cycle{{0.0, 1.0, 2.0, 1.0, 0.0}, {0.0, 10.0, 20.0, 40.0, 50.0}, {0.0, 1.0, 2.0, 3.0, 4.0}};
  EXPECT_EQ(error_of(cycle, cycle).largest, 0.0);
  EXPECT_EQ(error_of(cycle, cycle).peak, 0.0);
  // In half of the steps, 45 in place of 50 at the end, over a range of 50; by x alone that is 45 beside 0.
  const BenchCurve coarse{{0.0, 2.0, 0.0}, {0.0, 20.0, 45.0}, {0.0, 2.0, 4.0}};
  EXPECT_DOUBLE_EQ(error_of(coarse, cycle).largest, 0.1);
  EXPECT_DOUBLE_EQ(error_of(coarse, cycle).peak, 0.1);
  // Packings of their own: the mean of two such curves, and each of them, at the same times.
  std::vector<BenchResult> results{{{}, "done", 1, 1.0, 0.0, 0.0, {cycle}, {}, {}, {}, false}};
  for (const double part : {0.9, 1.1}) {
    BenchResult one = results.front();
    one.setting.grains = 100;
    for (double& value : one.curves.front().y) value *= part;
    results.push_back(one);
  }
  const std::vector<SizeScatter> sizes = compare_sizes(results);
  ASSERT_EQ(sizes.size(), 1U);
  EXPECT_NEAR(sizes[0].errors[0].largest, 0.0, 1e-14);
  // 45 and 55 at the end: a deviation of 10 / sqrt(2), over the range of 50.
  EXPECT_NEAR(sizes[0].deviations[0].largest, 0.2 / std::sqrt(2.0), 1e-14);
}

BenchResult result(double seconds, double error, const std::string& status) {
  return {{}, status, 1, seconds, 0.0, 0.0, {{{0.0, 1.0}, {0.0, 1.0 + error}}}, {}, {}, {}, false};
}

/// The same with a packing of bench's own.
BenchResult sized(int grains, double seconds, double error) {
  BenchResult made = result(seconds, error, "done");
  made.setting.grains = grains;
  return made;
}

TEST(BenchFront, HoldsWhatNothingBeats) {
  std::vector<BenchResult> results{result(100.0, 0.0, "done"), result(10.0, 0.02, "done"),
                                   result(20.0, 0.03, "done"), result(30.0, 0.01, "done"),
                                   result(1.0, 0.001, "stopped")};
  compare(results);
  mark_front(results);
  EXPECT_FALSE(results[0].on_front) << "the reference has no error to be judged by";
  EXPECT_TRUE(results[1].on_front);
  EXPECT_FALSE(results[2].on_front) << "slower and farther than the first";
  EXPECT_TRUE(results[3].on_front);
  EXPECT_FALSE(results[4].on_front) << "it has not come to its end";
}

TEST(BenchSizes, AreComparedWithTheMeanOfTheLargest) {
  std::vector<BenchResult> results{result(100.0, 0.0, "done"), result(1.0, 0.5, "done"),
                                   sized(100, 2.0, 0.10),      sized(100, 4.0, 0.30),
                                   sized(400, 20.0, -0.02),    sized(400, 30.0, 0.02)};
  compare(results);
  const std::vector<SizeScatter> sizes = compare_sizes(results);
  mark_front(results);
  ASSERT_EQ(sizes.size(), 2U);
  // Curves from 0 to 1 + error: the mean of the largest ends at 1, that of the others at 1.2.
  EXPECT_EQ(sizes[0].grains, 100);
  EXPECT_FALSE(sizes[0].is_reference);
  EXPECT_DOUBLE_EQ(sizes[0].seconds, 3.0);
  EXPECT_NEAR(sizes[0].errors[0].largest, 0.2, 1e-14);
  EXPECT_NEAR(sizes[0].errors[0].peak, 0.2, 1e-14);
  EXPECT_DOUBLE_EQ(sizes[0].peaks[0].mean, 1.2);
  EXPECT_DOUBLE_EQ(sizes[0].deviations[0].largest, 0.2 / std::sqrt(2.0));
  EXPECT_TRUE(sizes[1].is_reference);
  EXPECT_NEAR(sizes[1].errors[0].largest, 0.0, 1e-15);
  EXPECT_NEAR(sizes[1].deviations[0].peak, 0.04 / std::sqrt(2.0), 1e-15);
  EXPECT_DOUBLE_EQ(results[3].errors[0].largest, 0.3);
  EXPECT_DOUBLE_EQ(results[1].errors[0].largest, 0.5) << "settings keep the reference run";
  EXPECT_FALSE(results[2].on_front) << "its error is against another reference";
  EXPECT_TRUE(results[1].on_front) << "and so it beats no setting";
}

TEST(BenchSizes, WaitForTheLargest) {
  std::vector<BenchResult> results{result(100.0, 0.0, "done"), sized(100, 2.0, 0.1), sized(400, 9.0, 0.1)};
  results.back().status = "stopped";
  EXPECT_TRUE(compare_sizes(results).empty());
  EXPECT_TRUE(results[1].errors.empty());
  const BenchTable table = bench_table({"x", {"y"}, false}, results, {});
  EXPECT_FALSE(table.rows[1].figures[0].has_value());
}

TEST(BenchTables, SayWhereThereIsNoBand) {
  std::vector<BenchResult> results{result(100.0, 0.0, "done"), result(1.0, 0.5, "done")};
  results[0].band = {"", 55.0, 0.040, 0.03};
  results[1].band = {"its peak does not stand out", {}, {}, {}};
  compare(results);
  results.push_back(results[1]);
  results.back().band = {"", 50.0, 0.050, {}};
  const BenchTable table = bench_table({"x", {"y"}, true}, results, {});
  const auto cells = [&](std::size_t row) {
    const std::vector<std::string> all = cells_of(table, table.rows[row]);
    return std::vector<std::string>(all.end() - 7, all.end());
  };
  using Cells = std::vector<std::string>;
  EXPECT_EQ(cells(0), Cells({"55.0", "0.0", "40.0", "0.0", "3.00", "0.00", ""}));
  EXPECT_EQ(cells(1), Cells({"no band", "", "", "", "", "", ""}));
  EXPECT_EQ(cells(2), Cells({"50.0", "-5.0", "50.0", "10.0", "", "", ""}));
}

class BenchCommandTest : public ::testing::Test {
 protected:
  BenchCommandTest() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    testing::write(directory() / "fake.in", "softening 0.05\n");
    testing::write(directory() / "grains.csv",
                   "# cell xx=0.1 xy=0 yx=0 yy=0.1 z=0.1\nid,x,y,r,mass,Izz\n1,0.05,0.05,0.04,1.0,8e-4\n");
    write_case("case.yaml",
               "{model: cell, script: fake.in, packing: grains.csv, G: 40 MPa, Gc: 10 MPa, lc: 20 mm}");
    write_case("law.yaml",
               "{model: elastic, E: 100 MPa, nu: 0.25, Gc: 10 MPa, lc: 20 mm, confining: 100 kPa}");
  }
  void write_case(const std::string& name, const std::string& sand,
                  const std::string& plates =
                      "  - {on: bottom, fix: [u1, u2]}\n"
                      "  - {on: top, fix: [u1], move: {u2: -8 mm}}\n") {
    testing::write(directory() / name,
                   "title: Compression of a fake\n"
                   "mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [1, 2]}}\n"
                   "materials:\n  sand: " +
                       sand +
                       "\nregions: {all: sand}\n"
                       "boundary:\n" +
                       plates +
                       "  - {on: [left, right], pressure: 100 kPa}\n"
                       "steps: {count: 8, tolerance: 1e-6}\n"
                       "monitors:\n"
                       "  force: {on: top, reaction: u2}\n"
                       "  shortening: {on: top, displacement: u2}\n"
                       "  strain: -shortening / 0.8 m\n"
                       "output: {table: [shortening, force, volume_strain]}\n");
  }
  void write_specification(const std::string& script) {
    testing::write(directory() / "spec.yaml",
                   "grains: 400\nsizes: {law: uniform, radius: [3 mm, 7 mm]}\ndensity: 2650\n"
                   "thickness: 100 mm\nscript: " +
                       script + "\npressure: 100 kPa\nfriction: 0\nseed: 1\n");
  }
  /// "what,setting": the cells of the row by column.
  [[nodiscard]] std::map<std::string, std::map<std::string, std::string>> read_rows() const {
    const CsvTable csv(directory() / "out/bench.csv");
    std::map<std::string, std::map<std::string, std::string>> rows;
    for (std::size_t k = 0; k < csv.rows(); ++k) {
      std::map<std::string, std::string> row;
      for (std::size_t c = 0; c < csv.names().size(); ++c) row[csv.names()[c]] = csv.cell(k, c);
      rows[row.at("what") + "," + row.at("setting")] = row;
    }
    return rows;
  }
  [[nodiscard]] const std::filesystem::path& directory() const { return scratch_.path(); }
  [[nodiscard]] Outcome polargrain(const std::string& arguments) const {
    return run_in(directory(), FAKE_POLARGRAIN " " + arguments);
  }
  testing::Scratch scratch_;
};

TEST_F(BenchCommandTest, MeasuresTheGridAndWritesItsPages) {
  const Outcome outcome = polargrain("bench case.yaml law.yaml --quick -o out -w 1");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const std::string csv = content(directory() / "out/bench.csv");
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "case,what,setting,status,steps,seconds,cell_evaluations,dem_steps,error_force,peak_force,"
            "peak_error_force,error_volume_strain,peak_volume_strain,peak_error_volume_strain,front");
  for (const char* group : {",reference,", ",as given,", ",scheme,law.yaml,", ",equilibrium,",
                            ",loading rate,", ",adaptivity,tolerance 10 %,", ",step size,4 steps,"}) {
    EXPECT_NE(csv.find(group), std::string::npos) << group << '\n' << csv;
  }
  const std::string page = content(directory() / "out/bench.html");
  EXPECT_NE(page.find("<canvas"), std::string::npos);
  EXPECT_NE(page.find("\"title\":\"force\",\"unit\":\"N/m\""), std::string::npos) << "curves have units";
  EXPECT_NE(page.find("Speed against error: Compression of a fake"), std::string::npos);
  EXPECT_EQ(page.find("src="), std::string::npos) << "the page must stand alone";
  EXPECT_NE(outcome.errors.find("run 2 of "), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.errors.find(" left"), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.out.find("| as given |"), std::string::npos) << outcome.out;
}

TEST_F(BenchCommandTest, AnErrorOfAKnownSizeIsMeasured) {
  // The same elastic law, 1 % stiffer: the force above the confining one grows by 1 %, and so does its range.
  const Outcome outcome =
      polargrain("bench law.yaml --vary materials.sand.E=100e6,101e6 -o out -w 1 --y force");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const std::string csv = content(directory() / "out/bench.csv");
  const auto error_of_row = [&](const std::string& setting) {
    const std::size_t row = csv.find("," + setting + ",done,8,");
    EXPECT_NE(row, std::string::npos) << csv;
    std::istringstream cells(csv.substr(row + 1));
    std::string cell;
    for (int k = 0; k < 7; ++k) std::getline(cells, cell, ',');
    return std::stod(cell);
  };
  std::cout << "[figure] 1 % of stiffness measured as " << error_of_row("101e6") << '\n';
  // The reference takes twice the steps of a linear law: no difference but that of the tolerance, 1e-6. The
  // moduli Gc and the confinement do not scale, which leaves a few per cent of the 1 %.
  EXPECT_LT(error_of_row("100e6"), 1e-5);
  EXPECT_NEAR(error_of_row("101e6"), 0.01, 1e-3);
}

TEST_F(BenchCommandTest, MakesPackingsAndMeasuresTheirScatter) {
  // Homogeneous, so that the force above the confining one is proportional to the modulus, which is that of
  // the packing: 1 + (seed - 2) / 100 + 1 / grains.
  write_case("smooth.yaml",
             "{model: cell, script: mass.in, packing: grains.csv, G: 40 MPa, Gc: 10 MPa, lc: 20 mm}",
             "  - {on: bottom, fix: [u2]}\n  - {on: bottom_left, fix: [u1]}\n"
             "  - {on: top, move: {u2: -8 mm}}\n");
  testing::write(directory() / "mass.in", "young_of_mass 100e6\n");
  write_specification("mass.in");
  const std::string command =
      "bench smooth.yaml --quick -o out -w 1 --y force --pack spec.yaml --grains 100,400";
  const Outcome outcome = polargrain(command);
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_NE(outcome.errors.find("packing 4 of 6: 400 grains, seed 1\n"), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.out.find("the mean of the 3 packings of 400 grains"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("| mean | 100 grains | 3 packings |"), std::string::npos) << outcome.out;
  const auto rows = read_rows();
  const auto number = [&](const std::string& row, const std::string& column) {
    EXPECT_EQ(rows.count(row), 1U) << row;
    return std::stod(rows.at(row).at(column));
  };
  // The tolerance of the balance is 1e-6 of the forces, of which the range is a third.
  EXPECT_NEAR(number("cell size,400 grains; seed 3", "error_force"), 0.01 / 1.0025, 1e-5);
  EXPECT_NEAR(number("mean,100 grains", "error_force"), 0.0075 / 1.0025, 1e-5);
  EXPECT_NEAR(number("mean,400 grains", "error_force"), 0.0, 1e-12);
  EXPECT_NEAR(number("standard deviation,100 grains", "error_force"), 0.01 / 1.0025, 1e-5);
  // The force beyond the confining one, which pushes down, scatters as the modulus.
  const double peak = number("mean,400 grains", "peak_force") + 0.4 * 100e3;
  EXPECT_NEAR(number("standard deviation,400 grains", "peak_force"), 0.01 / 1.0025 * std::abs(peak),
              1e-5 * std::abs(peak));
  // Made once, and again only where what they are made from is another.
  const auto when = [&](const char* name) {
    return std::filesystem::last_write_time(directory() / "out/packings" / name);
  };
  const auto first = when("grains100-seed1.h5");
  const Outcome again = polargrain(command + " --seeds 1,2");
  ASSERT_EQ(again.status, 0) << again.errors;
  EXPECT_NE(again.errors.find("packing 1 of 4: 100 grains, seed 1, is there"), std::string::npos)
      << again.errors;
  EXPECT_EQ(when("grains100-seed1.h5"), first);
  testing::write(directory() / "mass.in", "young_of_mass 101e6\n");
  ASSERT_EQ(polargrain(command + " --seeds 1").status, 0);
  EXPECT_NE(when("grains100-seed1.h5"), first);
}

TEST_F(BenchCommandTest, BandsAreLookedForInEveryRun) {
  const Outcome outcome = polargrain(
      "bench case.yaml --quick -o out -w 1 --band 0.005,0.01 --vary output.every=7 --y force --x strain "
      "--set mesh.rectangle.elements=[2,4]");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const auto rows = read_rows();
  for (const auto& [name, row] : rows) EXPECT_FALSE(row.at("no_band").empty()) << name;
  EXPECT_NE(rows.at("output.every,7").at("no_band").find("the fields nearest to 0.005 and 0.01 are of"),
            std::string::npos)
      << rows.at("output.every,7").at("no_band");
  EXPECT_NE(outcome.out.find("no band"), std::string::npos) << outcome.out;
}

TEST_F(BenchCommandTest, BandsAreThoseOfTheCommandBand) {
  // A softening law with a weak corner makes a band.
  const Outcome outcome = polargrain("bench " POLARGRAIN_SOURCE_DIRECTORY
                                     "/cases"
                                     "/studies/biaxial_elastoplastic.yaml --quick --band 0.03,0.05 -o out -w "
                                     "1 --set mesh.rectangle.elements=[4,8] --set steps.tolerance=1e-5");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const auto rows = read_rows();
  const auto as_given = rows.at("as given,");
  const std::string json = content(directory() / "out/run-01/band.json");
  const auto of_json = [&](const std::string& key) {
    const std::string name = "\"" + key + "\": ";
    EXPECT_NE(json.find(name), std::string::npos) << json;
    return std::stod(json.substr(json.find(name) + name.size()));
  };
  // Bench takes the angle without its sign before it becomes degrees: the last bit may differ.
  EXPECT_DOUBLE_EQ(std::stod(as_given.at("band_inclination")), std::abs(of_json("inclination_degrees")));
  EXPECT_EQ(std::stod(as_given.at("band_thickness")), of_json("thickness"));
  EXPECT_EQ(std::stod(as_given.at("band_onset")), of_json("onset_strain"));
  std::cout << "[figure] band of " << of_json("inclination_degrees") << " degrees\n";
}

TEST_F(BenchCommandTest, NothingRunsWhenPackingsAreWrong) {
  const auto errors = [&](const std::string& arguments) {
    const Outcome outcome = polargrain("bench case.yaml -o out " + arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_FALSE(std::filesystem::exists(directory() / "out")) << arguments;
    return outcome.errors;
  };
  EXPECT_NE(errors("--pack nowhere.yaml").find("nowhere.yaml: there is no such file"), std::string::npos);
  write_specification("fake.in");
  EXPECT_NE(errors("--pack spec.yaml --grains 100,0").find("--grains"), std::string::npos);
  EXPECT_NE(errors("--pack spec.yaml --grains 100,100").find("100 is there twice"), std::string::npos);
  EXPECT_NE(errors("--pack spec.yaml --seeds 1,x").find("--seeds"), std::string::npos);
  EXPECT_NE(errors("--grains 100").find("--pack"), std::string::npos);
  EXPECT_NE(errors("--band 0.02,0.01").find("the second is larger"), std::string::npos);
  testing::write(directory() / "other.in", "softening 0.06\n");
  write_specification("other.in");
  EXPECT_NE(errors("--pack spec.yaml").find("spec.yaml:5: script: other.in has another content than fake.in"),
            std::string::npos)
      << errors("--pack spec.yaml");
  EXPECT_NE(polargrain("bench law.yaml -o out --pack spec.yaml").errors.find("no material with cells"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(directory() / "out"));
}

TEST_F(BenchCommandTest, GoesOnWhereItWasBrokenOff) {
  ASSERT_EQ(polargrain("bench case.yaml --quick -o out -w 1").status, 0);
  const auto expected = read_rows();
  const std::string log = content(directory() / "out/run-01/run.log");
  std::filesystem::remove_all(directory() / "out/run-04");
  std::filesystem::remove(directory() / "out/bench.csv");
  const Outcome again = polargrain("bench case.yaml --quick -o out -w 1 --resume");
  EXPECT_EQ(again.status, 0) << again.errors;
  const auto rows = read_rows();
  ASSERT_EQ(rows.size(), expected.size());
  for (const auto& [name, row] : expected) {
    for (const char* column : {"status", "steps", "cell_evaluations", "dem_steps", "error_force"})
      EXPECT_EQ(rows.at(name).at(column), row.at(column)) << name << ", " << column;
  }
  // Finished runs have not been done again.
  EXPECT_EQ(content(directory() / "out/run-01/run.log").substr(0, log.size()), log);

  const Outcome other = polargrain("bench case.yaml --quick -o out -w 1 --resume --set steps.count=3");
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.errors.find("this checkpoint is of another case"), std::string::npos) << other.errors;
}

TEST_F(BenchCommandTest, NothingRunsWhenACaseIsWrong) {
  write_case("wrong.yaml", "{model: elastic, E: -1, nu: 0.25, Gc: 10 MPa, lc: 20 mm}");
  const Outcome outcome = polargrain("bench law.yaml wrong.yaml -o out");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.errors.find("wrong.yaml:4: "), std::string::npos) << outcome.errors;
  EXPECT_FALSE(std::filesystem::exists(directory() / "out"));
  EXPECT_EQ(polargrain("bench law.yaml -o out --vary materials.sand.E").status, 2);
  EXPECT_EQ(polargrain("bench law.yaml -o out --y nothing").status, 2);
  EXPECT_FALSE(std::filesystem::exists(directory() / "out"));
}

}  // namespace
}  // namespace polargrain::app
