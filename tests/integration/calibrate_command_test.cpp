// SPDX-License-Identifier: GPL-2.0-or-later
// The command `calibrate` with cells that are linear or soften (fake_engine.hpp): parameters that curves were made with are
// found again, what the data do not tell is said, and bad input is found before anything runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::string kPacking = POLARGRAIN_SOURCE_DIRECTORY "/cases/biaxial/packing400.csv";
constexpr double kYoung = 150e6;
constexpr double kSoftening = 0.4;

class Calibrate : public ::testing::Test {
 protected:
  Calibrate() : scratch("calibrate") {
    write(scratch.path() / "true.in", "young 150e6\nsoftening 0.4\n");
    write(scratch.path() / "cell.in",
          "variable stiffness index 1e8\nvariable weakening index 0.2\nvariable limit equal 0.5\n"
          "variable unread index 1\nyoung ${stiffness}\nsoftening ${weakening}\nfail_beyond ${limit}\n");
  }

  Outcome run(const std::string& arguments) const {
    return run_in(scratch.path(), FAKE_POLARGRAIN " " + arguments);
  }

  /// The laboratory: the same test with the true parameters, a point every 0.2 %.
  void make_laboratory() const {
    const Outcome outcome =
        run("element --test biaxial --pressure 100kPa --set axial_strain=1% --set rows=5 "
            "--set tolerance=1e-8 --quiet -o lab " +
            kPacking + " true.in");
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
  }

  std::string specification(const std::string& parameters, const std::string& targets) const {
    return "packing: " + kPacking + "\nscript: cell.in\ntolerance: 1e-8\nparameters:\n" + parameters +
           "tests:\n  drained: {test: biaxial, pressure: 100 kPa, axial_strain: 1 %, rows: 5}\ntargets:\n" +
           targets;
  }

  void expect_fault(const std::string& text, const std::string& message) const {
    write(scratch.path() / "spec.yaml", text);
    const Outcome outcome = run("calibrate lab.csv spec.yaml");
    EXPECT_EQ(outcome.status, 2) << outcome.errors;
    EXPECT_NE(outcome.errors.find(message), std::string::npos) << outcome.errors;
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "calibration"));
  }

  Scratch scratch;
};

const std::string kBoth =
    "  stiffness: {bounds: [5e7, 5e8], start: 9e7}\n"
    "  weakening: {bounds: [0, 1], start: 0.1, scale: linear}\n";
const std::string kStress = "  - {column: s22_Pa, error: 500}\n";

TEST_F(Calibrate, FindsTheParametersThatTheCurveWasMadeWith) {
  make_laboratory();
  write(scratch.path() / "spec.yaml", specification(kBoth, kStress) + "search_tolerance: 5e-4\n");
  const Outcome outcome = run("calibrate lab.csv spec.yaml -o out -w 1");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const CsvTable table(scratch.path() / "out/parameters.csv");
  // The search stands still within 5e-4 of the way between the bounds; along the flat direction it is some times as far off.
  EXPECT_NEAR(table.numbers("best")[0] / kYoung, 1.0, 0.01);
  EXPECT_NEAR(table.numbers("best")[1], kSoftening, 0.01);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_LT(table.numbers("low_95")[k], table.numbers("best")[k]);
    EXPECT_GT(table.numbers("high_95")[k], table.numbers("best")[k]);
  }
  EXPECT_LE(table.numbers("low_95")[0], kYoung);
  EXPECT_GE(table.numbers("high_95")[0], kYoung);
  const std::string best = content(scratch.path() / "out/best.in");
  EXPECT_NE(best.find("variable limit equal 0.5"), std::string::npos);
  EXPECT_TRUE(best.starts_with("# found by polargrain calibrate\n")) << "a later run knows it by this line";
  const std::string page = content(scratch.path() / "out/calibration.html");
  EXPECT_NE(page.find("laboratory"), std::string::npos);
  EXPECT_NE(page.find("<th>95 % from</th>"), std::string::npos);

  // Broken off in the middle, it goes on to the same bytes.
  const std::string record = content(scratch.path() / "out/record.csv");
  std::size_t half = record.size() / 2;
  half = record.find('\n', half) + 1;
  write(scratch.path() / "out/record.csv", record.substr(0, half));
  const std::string parameters = content(scratch.path() / "out/parameters.csv");
  ASSERT_EQ(run("calibrate lab.csv spec.yaml -o out -w 2").status, 0);
  EXPECT_EQ(content(scratch.path() / "out/record.csv"), record);
  EXPECT_EQ(content(scratch.path() / "out/parameters.csv"), parameters);

  write(scratch.path() / "spec.yaml", specification(kBoth, kStress) + "search_tolerance: 1e-3\n");
  const Outcome other = run("calibrate lab.csv spec.yaml -o out");
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.errors.find("is the record of another calibration"), std::string::npos) << other.errors;
}

TEST_F(Calibrate, SaysWhatTheDataDoNotTell) {
  make_laboratory();
  write(scratch.path() / "spec.yaml", specification("  stiffness: {bounds: [5e7, 5e8], start: 9e7}\n"
                                                    "  limit: {bounds: [0.4, 0.6], start: 0.5}\n",
                                                    "  - {column: s11_Pa, largest: -100e3, error: 1e3}\n"
                                                    "  - {column: s22_Pa, last: -200e3, error: 1e3}\n" +
                                                        kStress));
  const Outcome outcome = run("calibrate lab.csv spec.yaml -o out -w 1");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const CsvTable table(scratch.path() / "out/parameters.csv");
  EXPECT_EQ(table.numbers("low_95")[1], 0.4);
  EXPECT_EQ(table.numbers("high_95")[1], 0.6);
  EXPECT_GT(table.numbers("low_95")[0], 6e7);
  EXPECT_NE(outcome.out.find("inf"), std::string::npos) << outcome.out;
}

TEST_F(Calibrate, ASearchWithTooFewEvaluationsIsNotDone) {
  make_laboratory();
  write(scratch.path() / "spec.yaml", specification(kBoth, kStress) + "evaluations: 6\n");
  const Outcome outcome = run("calibrate lab.csv spec.yaml -o out -w 1");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.out.find("not converged: 6 evaluations"), std::string::npos) << outcome.out;
}

TEST_F(Calibrate, TellsOfPointsThatNoTestReaches) {
  make_laboratory();
  const std::string far = specification(kBoth, kStress + "evaluations: 2\n");
  std::string shorter = far;
  shorter.replace(shorter.find("axial_strain: 1 %"), 17, "axial_strain: 0.5 %");
  // The laboratory's five points are 0.2 % apart and end at 1 %.
  write(scratch.path() / "spec.yaml", shorter);
  const Outcome missed = run("calibrate lab.csv spec.yaml -o short -w 1");
  EXPECT_NE(missed.errors.find("warning: 3 of "), std::string::npos) << missed.errors;
  EXPECT_NE(missed.errors.find("the first is s22_Pa of test 'drained' at axial_strain 0.006"),
            std::string::npos)
      << missed.errors;
  EXPECT_EQ(missed.errors.find("warning"), missed.errors.rfind("warning")) << "told once";
  shorter = specification(kBoth, "  - {column: s22_Pa, error: 500, from: 0.15 %}\n");
  shorter.replace(shorter.find("axial_strain: 1 %"), 17, "axial_strain: 0.1 %");
  write(scratch.path() / "spec.yaml", shorter);
  const Outcome all = run("calibrate lab.csv spec.yaml -o all -w 1");
  EXPECT_EQ(all.status, 1);
  EXPECT_NE(
      all.errors.find("no test comes as far as the points of the laboratory, the first is s22_Pa of test "
                      "'drained' at axial_strain 0.002"),
      std::string::npos)
      << all.errors;
  write(scratch.path() / "spec.yaml", far);
  EXPECT_EQ(run("calibrate lab.csv spec.yaml -o far -w 1").errors.find("warning"), std::string::npos);
}

// The search would end, and its parameters would fit a table of another unit or sign.
TEST_F(Calibrate, TellsOfOtherUnitsAndSigns) {
  make_laboratory();
  const auto warning = [&](const std::string& of_target) {
    write(scratch.path() / "spec.yaml",
          specification(kBoth, "  - {column: s22_Pa, error: 500, " + of_target + "}\n") + "evaluations: 1\n");
    std::filesystem::remove_all(scratch.path() / "out");
    return run("calibrate lab.csv spec.yaml -o out -w 1").errors;
  };
  const std::string in_kilopascals = warning("factor: 1e-3");
  EXPECT_NE(in_kilopascals.find("warning: s22_Pa of test 'drained': the laboratory has up to "),
            std::string::npos)
      << in_kilopascals;
  // As far off as per cent that the start underestimates or overestimates by a half: 1 / 0.015 is 67.
  const std::string in_percent = warning("factor: 0.015");
  EXPECT_NE(in_percent.find("0.01 for per cent"), std::string::npos) << in_percent;
  const std::string other_sign = warning("factor: -1");
  EXPECT_NE(other_sign.find("the laboratory and the test have opposite signs: give 'factor: -1'"),
            std::string::npos)
      << other_sign;
  const std::string beginning = warning("factor_along: 0.01");
  EXPECT_NE(beginning.find("the points of the laboratory end at axial_strain"), std::string::npos)
      << beginning;
  EXPECT_EQ(warning("factor: 1").find("warning"), std::string::npos);
}

// A strain that comes back has a value on each way; the first passage was compared with all of them.
TEST_F(Calibrate, AWayBackIsComparedWithItsOwnStage) {
  const auto text = [&](const std::string& stages, const std::string& target) {
    return "packing: " + kPacking + "\nscript: cell.in\ntolerance: 1e-8\nparameters:\n" +
           "  stiffness: {bounds: [5e7, 5e8], start: 150e6}\n"
           "  weakening: {bounds: [0, 1], start: 0.4, scale: linear}\n"
           "tests:\n  loop: {pressure: 100 kPa, stages: " +
           stages + "}\ntargets:\n  - {column: s22_Pa, error: 500" + target + "}\nevaluations: 1\n";
  };
  make_laboratory();
  const std::string there_and_back =
      "[{test: biaxial, axial_strain: 1 %, rows: 5}, {test: biaxial, axial_strain: 0.5 %, rows: 5}]";
  expect_fault(
      text(there_and_back, ""),
      "spec.yaml:10: target 1: along: axial_strain of test 'loop' comes to 0.006 more than once: give "
      "a target for each stage, with 'stage' (1 to 2)");
  expect_fault(text("[{test: biaxial, cycles: 1, amplitude: 1 %, rows: 8}]", ""),
               "more than once: write each way there and back as a stage of its own");
  expect_fault(text(there_and_back, ", stage: 3"), "target 1: stage: test 'loop' has stages 1 to 2");
  expect_fault(text(there_and_back, ", stage: 1}\n  - {column: s22_Pa, error: 500, stage: 2"),
               "for another stage of test 'loop' already: rename the column that names the samples");

  // Elastic cells under 200 kPa, strained by 0.042 % on the way there: points at 0, 0.02 and 0.04 % are passed twice.
  const std::string stages =
      "[{test: isotropic, to: 200 kPa, rows: 5}, {test: biaxial, axial_strain: 0.1 %, rows: 5, zero: yes}]";
  write(scratch.path() / "lab.yaml", "packing: " + kPacking + "\nscript: true.in\ntolerance: 1e-8\n" +
                                         "pressure: 100 kPa\nstages: " + stages + "\n");
  const Outcome made = run("element lab.yaml --quiet -o lab");
  ASSERT_EQ(made.status, 0) << made.errors;
  const std::string second = ", test_column: stage, lab_test: 2";
  write(scratch.path() / "spec.yaml", text(stages, second));
  const Outcome twice = run("calibrate lab.csv spec.yaml -o twice -w 1");
  EXPECT_EQ(twice.status, 1);
  EXPECT_NE(twice.errors.find("axial_strain of test 'loop' comes to 0 more than once"), std::string::npos)
      << twice.errors;
  write(scratch.path() / "spec.yaml", text(stages, second + ", stage: 2"));
  run("calibrate lab.csv spec.yaml -o once -w 1");
  const CsvTable record(scratch.path() / "once/record.csv");
  // Six points, at the parameters that the laboratory had: rounding of 1e-12 of 250 kPa is 1e-9 errors of 500 Pa.
  for (int k = 1; k <= 6; ++k)
    EXPECT_NEAR(record.number(0, record.column("difference_" + std::to_string(k))), 0.0, 1e-6) << k;
}

// Both would be fitted to the mean of the two curves.
TEST_F(Calibrate, RowsBelongToOneTest) {
  const std::string text = "packing: " + kPacking + "\nscript: cell.in\ntolerance: 1e-8\nparameters:\n" +
                           "  stiffness: {bounds: [5e7, 5e8], start: 9e7}\n"
                           "tests:\n  a: {test: biaxial, pressure: 100 kPa, axial_strain: 1 %, rows: 5}\n"
                           "  b: {test: biaxial, pressure: 50 kPa, axial_strain: 1 %, rows: 5}\n"
                           "targets:\n  - {test: a, column: s22_Pa, error: 500}\n"
                           "  - {test: b, column: s22_Pa, error: 500}\nevaluations: 1\n";
  write(scratch.path() / "lab.csv", "sample,axial_strain,s22_Pa\na,0.002,-4e5\nb,0.002,-3e5\n");
  expect_fault(
      text,
      "spec.yaml:11: target 2: target 1 has taken line 2 of the laboratory's table for test 'a' already: "
      "rename the column that names the samples (or parts of a test) to 'test'");
  write(scratch.path() / "lab.csv", "test,axial_strain,s22_Pa\na,0.002,-4e5\nb,0.002,-3e5\n");
  write(scratch.path() / "spec.yaml", text);
  const Outcome named = run("calibrate lab.csv spec.yaml -o out -w 1");
  EXPECT_NE(named.out.find("reading errors, of 2 points"), std::string::npos) << named.errors;
}

// A test that broke off has no end: its last row is not that, and a largest value there may be no peak.
TEST_F(Calibrate, ATestThatBreaksOffHasNoLastValue) {
  make_laboratory();
  const std::string cell = content(scratch.path() / "cell.in");
  // Refuses the first step; the row at the start, of -100 kPa, is there.
  std::string broken = cell;
  broken.replace(broken.find("equal 0.5"), 9, "equal 1e-9");
  write(scratch.path() / "cell.in", broken);
  write(scratch.path() / "spec.yaml", specification("  stiffness: {bounds: [5e7, 5e8], start: 9e7}\n",
                                                    "  - {column: s22_Pa, last: -100e3, error: 1e3}\n"
                                                    "  - {column: s22_Pa, largest: -100e3, error: 1e3}\n") +
                                          "evaluations: 1\n");
  const Outcome outcome = run("calibrate lab.csv spec.yaml -o out -w 1");
  EXPECT_NE(outcome.errors.find(
                "warning: test 'drained' broke off with the values of 'start' in 1 of 1 packings: "),
            std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("the box collapsed"), std::string::npos) << outcome.errors;
  const CsvTable record(scratch.path() / "out/record.csv");
  for (const char* const column : {"difference_1", "difference_2"})
    EXPECT_EQ(record.number(0, record.column(column)), 10.0) << "kMissed";
}

// Its curves would stay as they are through the whole search.
TEST_F(Calibrate, EachScriptHasEachParameter) {
  make_laboratory();
  expect_fault("packing: " + kPacking + "\nscript: cell.in\ntolerance: 1e-8\nparameters:\n" + kBoth +
                   "tests:\n  a: {test: biaxial, pressure: 100 kPa, axial_strain: 1 %, rows: 5}\n"
                   "  b: {test: biaxial, pressure: 100 kPa, axial_strain: 1 %, rows: 5, script: true.in}\n"
                   "targets:\n  - {test: a, column: s22_Pa, last: -200e3, error: 500}\n"
                   "  - {test: b, column: s22_Pa, last: -200e3, error: 500}\n",
               "parameter 'stiffness': true.in: ");
}

TEST_F(Calibrate, TheProfileSeeksTheOtherParametersAnew) {
  make_laboratory();
  write(scratch.path() / "spec.yaml",
        specification(kBoth, kStress) + "search_tolerance: 5e-4\nprofile: 6\nprofile_evaluations: 15\n");
  const Outcome outcome = run("calibrate lab.csv spec.yaml -o out -w 1");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_NE(outcome.out.find("re-optimised profile"), std::string::npos) << outcome.out;
  const CsvTable profile(scratch.path() / "out/profile.csv");
  const CsvTable parameters(scratch.path() / "out/parameters.csv");
  ASSERT_EQ(profile.rows(), 14u);  // three on each side of the best of each parameter
  const std::vector<double> misfits = profile.numbers("misfit");
  const double best = *std::ranges::min_element(misfits);
  const double width = parameters.numbers("high_95")[0] - parameters.numbers("best")[0];
  for (std::size_t row = 0; row < 7; ++row) {
    EXPECT_EQ(profile.cell(row, "held"), "stiffness");
    EXPECT_EQ(profile.cell(row, "within_95"), row >= 2 && row <= 4 ? "1" : "0");
    // Twice the interval of the linear estimate to each side, in three steps. One is within, four thirds are not.
    const double away = (profile.numbers("stiffness")[row] - parameters.numbers("best")[0]) / width;
    EXPECT_NEAR(std::abs(away), 2.0 / 3.0 * std::abs(static_cast<double>(row) - 3.0), 0.15);
    // Held too stiff, the sand has to soften more, and the other way round.
    if (row > 0) {
      EXPECT_GT(profile.numbers("weakening")[row], profile.numbers("weakening")[row - 1]);
    }
    if (row != 3) {
      EXPECT_GT(misfits[row], best);
    }
  }
}

TEST_F(Calibrate, PointsOutsideOfThePartThatCountsAreLeftOut) {
  make_laboratory();
  write(scratch.path() / "spec.yaml",
        specification("  stiffness: {bounds: [5e7, 5e8], start: 9e7}\n",
                      "  - {column: s22_Pa, error: 500, from: 0.3 %, to: 0.85 %}\n") +
            "evaluations: 3\n");
  EXPECT_NE(run("calibrate lab.csv spec.yaml -o out -w 1").out.find("reading errors, of 3 points"),
            std::string::npos);
  write(scratch.path() / "spec.yaml", specification(kBoth, "  - {column: s22_Pa, error: 500, from: 3 %}\n"));
  EXPECT_NE(run("calibrate lab.csv spec.yaml -o none").errors.find("between 'from' and 'to'"),
            std::string::npos);
}

TEST_F(Calibrate, PackingsOutOfRestAreSettledAndWhatCannotBeRunIsLeftOut) {
  make_laboratory();
  const std::string cell = content(scratch.path() / "cell.in");
  const auto calibrated = [&](const std::string& words, const std::string& folder) {
    write(scratch.path() / "cell.in", cell + words);
    write(scratch.path() / "spec.yaml", specification(kBoth, kStress) + "search_tolerance: 5e-4\n");
    return run("calibrate lab.csv spec.yaml -w 1 -o " + folder);
  };
  const Outcome settled = calibrated("settle_beyond 1e8\n", "settled");
  ASSERT_EQ(settled.status, 0) << settled.errors;
  const CsvTable found(scratch.path() / "settled/parameters.csv");
  EXPECT_NEAR(found.numbers("best")[0] / kYoung, 1.0, 0.01);
  EXPECT_EQ(settled.errors.find("left out"), std::string::npos) << settled.errors;

  // The first way of the search goes from 90 to 127 MPa, the best is at 150; 160 and above cannot be run.
  const Outcome out = calibrated("settle_beyond 1e8 restless_beyond 1.6e8\n", "left_out");
  EXPECT_NE(out.errors.find("left out, the tests could not be run: "), std::string::npos) << out.errors;
  const CsvTable record(scratch.path() / "left_out/record.csv");
  std::size_t count = 0;
  for (std::size_t row = 0; row < record.rows(); ++row) {
    const bool is_out = !record.cell(row, "left_out").empty();
    EXPECT_EQ(is_out, record.number(row, 0) > 1.6e8) << row;
    if (!is_out) continue;
    EXPECT_NE(record.cell(row, "left_out").find("the packing is not at rest"), std::string::npos);
    EXPECT_EQ(record.number(row, record.column("misfit")), 100.0);
    ++count;
  }
  EXPECT_GT(count, 0u);
  // The record is taken as it is: nothing is run again.
  const std::string whole = content(scratch.path() / "left_out/record.csv");
  EXPECT_EQ(calibrated("settle_beyond 1e8 restless_beyond 1.6e8\n", "left_out").errors, "");
  EXPECT_EQ(content(scratch.path() / "left_out/record.csv"), whole);

  // Where not even the start can be run, nothing is sought.
  const Outcome none = calibrated("restless_beyond 8e7\n", "none");
  EXPECT_EQ(none.status, 1);
  EXPECT_NE(none.errors.find("the packing is not at rest"), std::string::npos) << none.errors;
}

TEST_F(Calibrate, TheBestMayBeOneOfTheDerivatives) {
  make_laboratory();
  // A search that ends where it begins, far from the best: its derivatives lead on, and so do those beside them.
  write(scratch.path() / "spec.yaml",
        specification("  stiffness: {bounds: [5e7, 5e8], start: 9e7}\n", kStress) + "evaluations: 1\n");
  const Outcome outcome = run("calibrate lab.csv spec.yaml -o out -w 1");
  EXPECT_EQ(outcome.status, 1) << outcome.errors;
  const CsvTable record(scratch.path() / "out/record.csv");
  const std::vector<double> misfits = record.numbers("misfit");
  const auto least = static_cast<std::size_t>(std::ranges::min_element(misfits) - misfits.begin());
  EXPECT_GT(least, 2u);
  EXPECT_EQ(CsvTable(scratch.path() / "out/parameters.csv").numbers("best")[0], record.number(least, 0));
}

TEST_F(Calibrate, PackingsAreBroughtToTheirVoidRatio) {
  make_laboratory();
  write(
      scratch.path() / "loose.yaml",
      "grains: 9\nsizes: {law: uniform, radius: [1 m, 2 m]}\ndensity: 1000\nthickness: 1 m\nscript: loose.in\n"
      "pressure: 10 kPa\nfriction: 0.5\nseed: 1\n");
  write(scratch.path() / "loose.in", "variable friction index 0.5\nyoung ${friction}\n");
  const std::string packing = "packing: {specification: loose.yaml, seeds: [3, 4]}\nvoid_ratio: ";
  const std::string rest =
      "\nscript: cell.in\ntest: biaxial\npressure: 100 kPa\naxial_strain: 1 %\nrows: 5\n";
  // A fault in the rest of it is found before a packing is made.
  write(scratch.path() / "test.yaml", packing + "0.62" + rest + "drained: yes\n");
  EXPECT_EQ(run("element test.yaml -o made").status, 2);
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "packings"));

  write(scratch.path() / "test.yaml", packing + "0.62" + rest);
  const Outcome made = run("element test.yaml -o made");
  ASSERT_EQ(made.status, 0) << made.errors;
  EXPECT_NE(made.out.find("seed3-e0.62-100kPa"), std::string::npos) << made.out;
  // 0.5 + 0.4 friction: steps of 0.85 from 0.5 to 0.3071 and 0.2610 enclose it; a secant of a line hits at once.
  EXPECT_NE(made.errors.find("packing seed4-step4.h5: void ratio 0.6044"), std::string::npos) << made.errors;
  EXPECT_NE(made.errors.find("packing seed4-e0.62-100kPa"), std::string::npos) << made.errors;
  EXPECT_NE(made.errors.find(": void ratio 0.62"), std::string::npos) << made.errors;
  EXPECT_EQ(made.errors.find("step5"), std::string::npos) << made.errors;
  // They are kept, for other tests too.
  const std::string table = content(scratch.path() / "made.csv");
  EXPECT_EQ(run("element test.yaml -o made").errors, "");
  EXPECT_EQ(content(scratch.path() / "made.csv"), table);

  write(scratch.path() / "test.yaml", packing + "0.75" + rest);
  EXPECT_NE(run("element test.yaml -o made").errors.find("the loosest packing of seed 3 has 0.7000"),
            std::string::npos);
  write(scratch.path() / "test.yaml", packing + "0.4" + rest);
  EXPECT_NE(run("element test.yaml -o made").errors.find("seed 3 comes to 0.50"), std::string::npos);

  // The tests of a calibration each have theirs.
  write(scratch.path() / "lab2.csv", "s22_Pa\n-2e5\n");
  write(
      scratch.path() / "spec.yaml",
      "packing: {specification: loose.yaml, seeds: [3]}\nscript: cell.in\nparameters:\n" + kBoth +
          "tests:\n  one: {test: biaxial, void_ratio: 0.6, pressure: 100 kPa, axial_strain: 1 %, rows: 5}\n"
          "  two: {test: biaxial, void_ratio: 0.65, pressure: 50 kPa, axial_strain: 1 %, rows: 5}\ntargets:\n"
          "  - {test: one, column: s22_Pa, last: -2e5, error: 1e3}\n"
          "  - {test: two, column: s22_Pa, last: -1e5, error: 1e3}\nevaluations: 3\n");
  const Outcome calibrated = run("calibrate lab2.csv spec.yaml -o both -w 1");
  EXPECT_EQ(calibrated.status, 1) << calibrated.errors;
  EXPECT_NE(calibrated.errors.find("seed3-e0.6-100kPa"), std::string::npos) << calibrated.errors;
  EXPECT_NE(calibrated.errors.find("seed3-e0.65-50kPa"), std::string::npos) << calibrated.errors;
}

TEST_F(Calibrate, SaysWhatIsWrongBeforeAnythingRuns) {
  make_laboratory();
  expect_fault(specification("  softness: {bounds: [1, 2], start: 1.5}\n", kStress),
               "spec.yaml:5: parameter 'softness': ");
  expect_fault(specification("  softness: {bounds: [1, 2], start: 1.5}\n", kStress),
               "the script has no line 'variable softness index VALUE'");
  expect_fault(specification("  unread: {bounds: [1, 2], start: 1.5}\n", kStress),
               "sets the variable unread but never reads it");
  expect_fault(specification("  stiffness: {bounds: [1e8, 2e8], start: 3e8}\n", kStress),
               "spec.yaml:5: parameter 'stiffness': start: 3e+08 is outside of the bounds");
  expect_fault(
      specification(kBoth, "  - {column: s22_Pa, lab: sigma1, error: 1e3}\n"),
      "spec.yaml:10: target 1: the laboratory's table has no column 'sigma1'; it has packing, stage");
  expect_fault(specification("  stiffness: {bounds: [2e8, 1e8], start: 1.5e8}\n", kStress),
               "spec.yaml:5: parameter 'stiffness': bounds: the first must be the smaller one");
  expect_fault(
      specification(kBoth, "  - {column: s22_Pa, error: 1e3, test_column: id}\n"),
      "spec.yaml:10: target 1: the laboratory's table has no column 'id' that says which test a row belongs to");
  expect_fault(specification(kBoth, "  - {column: s22_Pa, error: 1e3, lab_test: other}\n"),
               "has no column 'test' that says which test a row belongs to");
  // A bound that is refused is not compared with the others.
  write(scratch.path() / "spec.yaml",
        specification("  stiffness: {bounds: [0, 2e8], start: 1.5e8}\n", kStress));
  const std::string bound = run("calibrate lab.csv spec.yaml").errors;
  EXPECT_NE(bound.find("spec.yaml:5: parameter 'stiffness': bounds: must be greater than zero"),
            std::string::npos)
      << bound;
  EXPECT_EQ(std::ranges::count(bound, '\n'), 1) << bound;
  expect_fault(specification(kBoth, "  - {column: s22, error: 1e3}\n"),
               "target 1: column: expected one of stage, row");
  expect_fault(specification(kBoth, "  - {column: s22_Pa, last: -1, error: 1e3}\n"),
               "1 points cannot tell 2 parameters");
  expect_fault("packing: none.h5\n" + specification(kBoth, kStress), "the key 'packing' was given before");
}

}  // namespace
}  // namespace polargrain::testing
