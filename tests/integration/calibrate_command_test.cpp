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
  EXPECT_NE(content(scratch.path() / "out/best.in").find("variable limit equal 0.5"), std::string::npos);
  EXPECT_NE(content(scratch.path() / "out/calibration.html").find("laboratory"), std::string::npos);

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
                                                    "  - {column: s22_Pa, largest: -100e3, error: 1e3}\n"
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
  expect_fault(specification(kBoth, "  - {column: s22, error: 1e3}\n"),
               "target 1: column: expected one of stage, row");
  expect_fault(specification(kBoth, "  - {column: s22_Pa, last: -1, error: 1e3}\n"),
               "1 points cannot tell 2 parameters");
  expect_fault("packing: none.h5\n" + specification(kBoth, kStress), "the key 'packing' was given before");
}

}  // namespace
}  // namespace polargrain::testing
