// SPDX-License-Identifier: GPL-2.0-or-later
// Whole runs of the program, with the fake engine in its workers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"
#include "tests/support/eventually.hpp"

namespace polargrain::testing {
namespace {

class RunTest : public ::testing::Test {
 protected:
  RunTest() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    set_script("");
    write(directory() / "grains.csv",
          "# cell xx=0.1 xy=0 yx=0 yy=0.1 z=0.1\nid,x,y,r,mass,Izz\n1,0.05,0.05,0.04,1.0,8e-4\n");
    write(directory() / "case.yaml",
          case_text("{model: cell, script: fake.in, packing: grains.csv, G: 40 MPa, "
                    "Gc: 10 MPa, lc: 20 mm}"));
  }

  static std::string case_text(const std::string& sand) {
    return "title: Compression of a fake\n"
           "mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [2, 4]}}\n"
           "materials:\n  sand: " +
           sand +
           "\nregions: {all: sand}\n"
           "boundary:\n"
           "  - {on: bottom, fix: [u2]}\n"
           "  - {on: bottom_left, fix: [u1, w]}\n"
           "  - {on: top, move: {u2: -8 mm}}\n"
           "  - {on: [left, right], pressure: 100 kPa}\n"
           "steps: {count: 5, tolerance: 1e-10}\n"
           "monitors:\n"
           "  top_force: {on: top, reaction: u2}\n"
           "  shortening: {on: top, displacement: u2}\n"
           "  axial_strain: -shortening / 0.8 m\n"
           "  stress_ratio: -top_force / (0.4 m * 100 kPa)\n"
           "output: {every: 2, table: [axial_strain, stress_ratio, volume_strain]}\n";
  }

  void set_script(const std::string& text) { write(directory() / "fake.in", text + "\n"); }
  [[nodiscard]] const std::filesystem::path& directory() const { return scratch_.path(); }
  [[nodiscard]] Outcome polargrain(const std::string& arguments) const {
    return run_in(directory(), FAKE_POLARGRAIN " " + arguments);
  }
  [[nodiscard]] std::string result(const std::string& file) const { return content(directory() / file); }

  /// Values of a column of a CSV file, from its second line.
  [[nodiscard]] std::vector<double> column(const std::string& file, const std::string& name) const {
    return CsvTable(directory() / file).numbers(name);
  }

  Scratch scratch_;
};

// Shear by 0.2 between plates: the continuum turns by 0.1 rad, which small deformation leaves out of the stresses.
TEST_F(RunTest, SaysWhereSmallDeformationIsOutgrown) {
  const std::string shear =
      "title: Simple shear\n"
      "mesh: {rectangle: {size: [0.4 m, 0.4 m], elements: [1, 1]}}\n"
      "materials: {block: {model: elastic, E: 100 MPa, nu: 0.25, Gc: 10 MPa, lc: 20 mm}}\n"
      "regions: {all: block}\n"
      "boundary:\n"
      "  - {on: bottom, fix: [u1, u2]}\n"
      "  - {on: top, fix: [u2], move: {u1: 80 mm}}\n"
      "steps: {count: 10, tolerance: 1e-8}\n";
  write(directory() / "shear.yaml", shear);
  const auto times_said = [](const std::string& text) {
    int count = 0;
    for (std::size_t at = text.find("small deformation leaves out"); at != std::string::npos;
         at = text.find("small deformation leaves out", at + 1))
      ++count;
    return count;
  };
  const Outcome small = polargrain("run shear.yaml -o small");
  ASSERT_EQ(small.status, 0) << small.errors;
  EXPECT_EQ(times_said(small.out + small.errors), 1) << small.out << small.errors;
  EXPECT_EQ(times_said(result("small/run.log")), 1);
  EXPECT_EQ(times_said(polargrain("run shear.yaml -o less --set boundary.1.move.u1=20e-3").errors), 0);
  const Outcome large = polargrain("run shear.yaml -o large --set deformation=large");
  ASSERT_EQ(large.status, 0) << large.errors;
  EXPECT_EQ(times_said(large.out + large.errors + result("large/run.log")), 0);
}

// Fixed below, free above: it buckles under pi^2 E I / (2 L)^2 = 12.85 kPa. No step comes after the last one, to look back at it.
TEST_F(RunTest, SaysWhereAColumnEndsBeyondItsLoad) {
  const auto column = [](const std::string& load) {
    return "title: A column\n"
           "mesh: {rectangle: {size: [10 cm, 4 m], elements: [1, 10]}}\n"
           "continuum: cauchy\ndeformation: large\n"
           "materials: {block: {model: elastic, E: 100 MPa, nu: 0}}\n"
           "regions: {all: block}\n"
           "boundary:\n"
           "  - {on: bottom, fix: [u1, u2]}\n"
           "  - {on: top, traction: {u2: [[0, 0], [1, -" +
           load +
           "]]}}\n"
           "steps: {count: 4, tolerance: 1e-6}\n";
  };
  const std::string said = "the balance at the end of step 4 is unstable or has passed a bifurcation";
  write(directory() / "beyond.yaml", column("13.5 kPa"));
  const Outcome beyond = polargrain("run beyond.yaml -o beyond");
  ASSERT_EQ(beyond.status, 0) << beyond.errors;
  EXPECT_NE((beyond.out + beyond.errors).find(said), std::string::npos) << beyond.out << beyond.errors;
  EXPECT_NE(result("beyond/run.log").find(said), std::string::npos);
  write(directory() / "below.yaml", column("12 kPa"));
  const Outcome below = polargrain("run below.yaml -o below");
  ASSERT_EQ(below.status, 0) << below.errors;
  EXPECT_EQ((below.out + below.errors).find("unstable"), std::string::npos) << below.errors;
}

TEST_F(RunTest, ModuliThatNobodyGivesComeFromThePacking) {
  write(directory() / "open.yaml",
        case_text("{model: cell, script: fake.in, packing: grains.csv, lc: 20 mm}"));
  const Outcome open = polargrain("run open.yaml -o open -w 1");
  ASSERT_EQ(open.status, 0) << open.errors;
  // The fake is linear with E = 100 MPa, nu = 0.25: G = 40 MPa; Gc and couple modulus are fake_engine.cpp's.
  EXPECT_NE(open.errors.find(
                "moduli of the packing at rest: G 40 MPa, Gc 10 MPa, nu 0.25, couple modulus 3.2e+04 N "
                "(length 20 mm)"),
            std::string::npos)
      << open.errors;
  write(directory() / "given.yaml",
        case_text("{model: cell, script: fake.in, packing: grains.csv, G: 40 MPa, Gc: 10 MPa, lc: 20 mm}"));
  const Outcome given = polargrain("run given.yaml -o given -w 1");
  EXPECT_EQ(given.errors.find("moduli of the packing"), std::string::npos) << given.errors;
  EXPECT_EQ(result("open/history.csv"), result("given/history.csv"));
  write(directory() / "no_length.yaml", case_text("{model: cell, script: fake.in, packing: grains.csv}"));
  EXPECT_NE(polargrain("check no_length.yaml").errors.find("the key 'lc' is missing"), std::string::npos);
}

// Exact: plane strain with constant lateral stress, E = 100 MPa, nu = 0.25, 1 % of axial strain on top of 100
// kPa: s22 = -100 kPa - E/(1-nu^2) 0.01; volume strain -0.01 (1 - nu/(1-nu)).
TEST_F(RunTest, ABiaxialTestOfALinearCellIsExact) {
  const Outcome outcome = polargrain("run case.yaml -o out -w 2");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const std::vector<double> ratio = column("out/history.csv", "stress_ratio");
  const std::vector<double> volume = column("out/history.csv", "volume_strain");
  ASSERT_EQ(ratio.size(), 6u);
  const double expected = 1.0 + 100e6 / (1.0 - 0.0625) * 0.01 / 100e3;
  std::cout << "[figure] stress ratio " << ratio.back() << ", exact " << expected << '\n';
  EXPECT_NEAR(ratio.front(), 1.0, 1e-9);
  // The tolerance asked for, 1e-10, with room for the ratio of 12 to the reference force.
  EXPECT_NEAR(ratio.back(), expected, 1e-8);
  EXPECT_NEAR(volume.back(), -0.01 * (1.0 - 0.25 / 0.75), 1e-11);
}

TEST_F(RunTest, WritesWhatItPromises) {
  const Outcome outcome = polargrain("run case.yaml -o out -w 1");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  for (const char* file :
       {"history.csv", "costs.csv", "fields.pvd", "summary.json", "run.log", "logs/worker-1.log",
        "fields/step-00000.vtu", "fields/step-00002.vtu", "fields/step-00004.vtu", "fields/step-00005.vtu",
        "points.pvd", "fields/points-00000.vtu", "fields/points-00005.vtu"}) {
    EXPECT_TRUE(std::filesystem::exists(directory() / "out" / file)) << file;
  }
  // A field of cells has the unit of its record, wherever it stands.
  for (const char* file : {"out/fields/step-00005.vtu", "out/fields/points-00005.vtu"}) {
    const std::string text = result(file);
    const std::size_t array = text.find("Name=\"mean_rotation\"");
    ASSERT_NE(array, std::string::npos) << file;
    const std::size_t unit = text.find("UNITS_LABEL\" location=\"vtkDataArray\">", array);
    EXPECT_EQ(text.substr(text.find('>', unit) + 1, 4), "rad<") << file;
  }
  ASSERT_EQ(polargrain("run case.yaml -o without -w 1 --quiet --set output.points=no").status, 0);
  EXPECT_FALSE(std::filesystem::exists(directory() / "without/points.pvd"));
  EXPECT_FALSE(std::filesystem::exists(directory() / "without/fields/points-00005.vtu"));
  EXPECT_FALSE(std::filesystem::exists(directory() / "out/fields/step-00001.vtu"));
  EXPECT_EQ(result("out/history.csv").substr(0, result("out/history.csv").find('\n')),
            "step,time,substeps,cuts,iterations,evaluations,force_residual,moment_residual,force_noise,"
            "within_noise,within_rounding,limited,jumps,jump_residual,volume_strain,"
            "external_work,internal_work,top_force,shortening,axial_strain,stress_ratio");
  EXPECT_NE(result("out/summary.json").find("\"status\": \"done\""), std::string::npos);
  EXPECT_NE(outcome.out.find("Newton iterations"), std::string::npos);
  EXPECT_NE(outcome.out.find("grains"), std::string::npos);
  EXPECT_NE(outcome.out.find("results: out (history.csv"), std::string::npos);
}

TEST_F(RunTest, SaysWhereStrainsWereLimited) {
  // 0.2 % of axial strain a step, 0.25 % in norm: more than an iteration may ask for, so every step is cut.
  const Outcome outcome = polargrain("run case.yaml -o out -w 1 --set steps.largest_strain=0.0015");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_GE(column("out/history.csv", "limited")[1], 1.0);
  EXPECT_GE(column("out/history.csv", "cuts")[1], 1.0);
  EXPECT_NE(outcome.out.find("corrections asked for too large a strain"), std::string::npos) << outcome.out;
  EXPECT_EQ(result("out/summary.json").find("\"corrections_limited\": 0"), std::string::npos);
  EXPECT_NE(result("out/run.log").find("corrections asked for strains beyond 0.0015"), std::string::npos);
  // The answer is that of the steps as they were asked for: the cell is linear.
  const double expected = 1.0 + 100e6 / (1.0 - 0.0625) * 0.01 / 100e3;
  EXPECT_NEAR(column("out/history.csv", "stress_ratio").back(), expected, 1e-8);
}

TEST_F(RunTest, OneAndTwoWorkersWriteTheSameHistory) {
  ASSERT_EQ(polargrain("run case.yaml -o one -w 1").status, 0);
  ASSERT_EQ(polargrain("run case.yaml -o two -w 2").status, 0);
  EXPECT_EQ(result("one/history.csv"), result("two/history.csv"));
  EXPECT_GT(result("one/history.csv").size(), 500u);
}

TEST_F(RunTest, ACellOfALinearLawEqualsTheLinearLaw) {
  ASSERT_EQ(polargrain("run case.yaml -o cells -w 2").status, 0);
  // The fake's law as a local material, with the couple modulus of the cell's case: G = 40 MPa, lc^2 2 G.
  write(directory() / "case.yaml",
        case_text("{model: elastic, E: 100 MPa, nu: 0.25, Gc: 10 MPa, lc: 20 mm, confining: 100 kPa}"));
  ASSERT_EQ(polargrain("run case.yaml -o elastic").status, 0);
  const std::vector<double> cells = column("cells/history.csv", "top_force");
  const std::vector<double> elastic = column("elastic/history.csv", "top_force");
  ASSERT_EQ(cells.size(), elastic.size());
  for (std::size_t s = 0; s < cells.size(); ++s) {
    EXPECT_NEAR(cells[s], elastic[s], 1e-9 * std::abs(elastic[s]));  // tolerance of the steps, 1e-10
  }
}

// Mohr-Coulomb in plane strain: s1 = s3 (1 + sin phi)/(1 - sin phi) + 2 c cos phi/(1 - sin phi).
TEST_F(RunTest, AnElastoplasticSpecimenCollapsesAtItsMohrCoulombStrength) {
  write(directory() / "case.yaml",
        case_text("{model: elastoplastic, E: 100 MPa, nu: 0.25, Gc: 10 MPa, lc: 20 mm, confining: 100 kPa, "
                  "friction_angle: 30 deg, dilatancy_angle: 0, cohesion: 1 kPa}"));
  const Outcome outcome =
      polargrain("run case.yaml -o out --set steps.count=20 --set boundary.2.move.u2=-40mm");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const double expected = (3.0 * 100e3 + 2.0 * std::sqrt(3.0) * 1e3) / 100e3;
  const double ratio = column("out/history.csv", "stress_ratio").back();
  std::cout << "[figure] stress ratio at collapse " << ratio << ", exact " << expected << '\n';
  // The out-of-plane stress nears its limit exponentially; at 5 % of strain less than this is left.
  EXPECT_NEAR(ratio, expected, 1e-6);
}

TEST_F(RunTest, AFailingCellCutsTheStep) {
  // Steps of 0.2 % of strain, of which the fake takes 0.11 %; halving once is enough.
  set_script("fail_beyond 1.1e-3");
  const Outcome outcome = polargrain("run case.yaml -o out -w 2");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_GE(column("out/history.csv", "cuts").at(1), 1.0);
  EXPECT_NEAR(column("out/history.csv", "stress_ratio").back(), 1.0 + 100e6 / (1.0 - 0.0625) * 0.01 / 100e3,
              1e-8);
  EXPECT_NE(result("out/run.log").find("given up"), std::string::npos);
}

TEST_F(RunTest, AStepThatCannotBeTakenEndsTheRunHonestly) {
  set_script("fail_beyond 1e-9");
  const Outcome outcome = polargrain("run case.yaml -o out -w 1 --set steps.cut=2");
  EXPECT_EQ(outcome.status, 1);
  const std::size_t cut = outcome.errors.find("warning: this step has been cut twice: a material failed: ");
  const std::size_t end = outcome.errors.find("error: step 1 of 5 did not converge: ");
  ASSERT_NE(end, std::string::npos) << outcome.errors;
  ASSERT_NE(cut, std::string::npos) << outcome.errors;
  for (const std::size_t from : {cut, end}) {  // after the second cut, and at the end
    const std::string text = outcome.errors.substr(from, end > from ? end - from : std::string::npos);
    EXPECT_NE(text.find("points have no good answer:\n    point "), std::string::npos) << text;
    EXPECT_NE(text.find(" of element "), std::string::npos) << text;
    EXPECT_NE(text.find("worth trying below 'steps': count: 10 (shorter steps)"), std::string::npos) << text;
  }
  EXPECT_NE(result("out/summary.json").find("\"status\": \"failed\""), std::string::npos);
  EXPECT_EQ(column("out/history.csv", "step").size(), 1u);
}

// Pulled until the whole body is in tension: all grains part, and every place that counts says the same.
TEST_F(RunTest, PointsAtTheirLimitsAreToldInTheTableTheSummaryTheLogAndByVerify) {
  const std::string pull = " -w 2 --set boundary.2.move.u2=8mm";
  const auto sentence_of = [&](const std::string& directory_of_run) {
    const std::string summary = result(directory_of_run + "/summary.json");
    const std::string key = "\"all\": \"of ";
    const std::size_t place = summary.find(key, std::min(summary.find("\"at_limits\""), summary.size()));
    if (place == std::string::npos) return std::string();
    const std::size_t begin = place + key.size() - 3;
    return summary.substr(begin, summary.find('"', begin) - begin);
  };
  const Outcome whole = polargrain("run case.yaml -o whole" + pull);
  ASSERT_EQ(whole.status, 0) << whole.errors;
  const std::string sentence = sentence_of("whole");
  ASSERT_NE(sentence, "") << result("whole/summary.json");
  const std::string points = sentence.substr(3, sentence.find(' ', 3) - 3);
  EXPECT_EQ(sentence, "of " + points + " points at the end (in any step): " + points +
                          " have grains that have parted (at most " + points + "); " + points +
                          " have a micro-rotation that is held numerically (at most " + points + ")");
  EXPECT_NE(whole.out.find("region 'all': " + sentence), std::string::npos) << whole.out;
  EXPECT_NE(result("whole/run.log").find("region 'all': " + sentence), std::string::npos);
  for (const char* const name : {"points_parted", "points_parted_most", "rotation_held"}) {
    EXPECT_NE(result("whole/summary.json").find(std::string("\"") + name + "\": " + points + ".0"),
              std::string::npos)
        << name << '\n'
        << result("whole/summary.json");
    EXPECT_NE(whole.out.find(std::string("  ") + name + " "), std::string::npos) << whole.out;
  }
  EXPECT_NE(result("whole/summary.json").find("\"at_skew_limit_most\": 0.0"), std::string::npos);
  EXPECT_NE(result("whole/fields/points-00005.vtu").find("Name=\"parted\""), std::string::npos);
  const Outcome verified = polargrain("verify whole -w 1");
  EXPECT_EQ(verified.status, 0) << verified.out << verified.errors;
  EXPECT_NE(verified.out.find("region 'all': " + sentence), std::string::npos) << verified.out;
  // Steps that are cut count no point twice.
  set_script("fail_beyond 1.1e-3");
  const Outcome cut = polargrain("run case.yaml -o cut" + pull);
  ASSERT_EQ(cut.status, 0) << cut.errors;
  ASSERT_GE(column("cut/history.csv", "cuts").at(1), 1.0);
  EXPECT_EQ(sentence_of("cut"), sentence);
  // Pressed together no point is at a limit, and nothing is said.
  set_script("");
  const Outcome pressed = polargrain("run case.yaml -o pressed -w 2");
  ASSERT_EQ(pressed.status, 0) << pressed.errors;
  EXPECT_EQ(sentence_of("pressed"), "");
  EXPECT_EQ(pressed.out.find("have parted"), std::string::npos) << pressed.out;
}

TEST_F(RunTest, GrainsLostOnEveryTryEndTheRunInTheEnginesWords) {
  set_script("die_beyond 1e-5");
  const Outcome outcome =
      polargrain("run case.yaml -o out -w 1 --quiet --set steps.cut=1 --set mesh.rectangle.elements=[1,1]");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.errors.find("error: step 1 of 5 did not converge"), 0u) << outcome.errors;
  EXPECT_NE(outcome.errors.find(
                "worker 1 died at work on point 0 of material 'sand' (fake.in): exit status 1; its log "
                "out/logs/worker-1.log says:\n"
                "ERROR: Lost atoms: original 400 current 399 (../thermo.cpp:396)\n"),
            std::string::npos)
      << outcome.errors;
  EXPECT_NE(result("out/summary.json").find("Lost atoms"), std::string::npos);
  EXPECT_NE(result("out/run.log").find("its cell goes to another worker"), std::string::npos);
}

TEST_F(RunTest, ABrokenScriptEndsTheRunInTheEnginesWords) {
  set_script("young 1e8\npear_style gran");
  EXPECT_EQ(polargrain("run case.yaml -o out -w 2 --quiet").status, 2);
  const Outcome outcome = polargrain("run case.yaml -o out -w 2 --quiet --trust-scripts");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.errors.find("ERROR: Unknown command: pear_style (../input.cpp:209)"), std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("out/logs/worker-"), std::string::npos);
}

TEST_F(RunTest, QuietSaysNothing) {
  const Outcome outcome = polargrain("run case.yaml -o out --quiet");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.errors, "");
}

TEST_F(RunTest, AFormerResultIsReplaced) {
  ASSERT_EQ(polargrain("run case.yaml -o out --quiet").status, 0);
  const std::string first = result("out/history.csv");
  write(directory() / "out" / "notes.txt", "mine");
  ASSERT_EQ(polargrain("run case.yaml -o out --quiet --set steps.count=2 --set output.every=2").status, 0);
  EXPECT_NE(result("out/history.csv"), first);
  EXPECT_FALSE(std::filesystem::exists(directory() / "out/fields/step-00005.vtu"));
  EXPECT_EQ(result("out/notes.txt"), "mine");
}

TEST_F(RunTest, ResultsGoBelowTheCurrentDirectoryByDefault) {
  std::filesystem::create_directories(directory() / "slope");
  write(directory() / "slope" / "case.yaml",
        case_text("{model: elastic, E: 100 MPa, nu: 0.25, Gc: 10 MPa, lc: 20 mm, confining: 100 kPa}"));
  ASSERT_EQ(polargrain("run slope/case.yaml --quiet").status, 0);
  EXPECT_TRUE(std::filesystem::exists(directory() / "results/slope/summary.json"));
}

TEST_F(RunTest, WorkersDieWithTheirCoordinator) {
  set_script("sleep_milliseconds 30");
  const Outcome outcome =
      run_in(directory(), "(" FAKE_POLARGRAIN
                          " run case.yaml -o out -w 2 --quiet & P=$!; "
                          "until grep -q 'workers started' out/run.log; do sleep 0.05; done; "
                          "cat /proc/$P/task/$P/children; kill -9 $P)");
  std::istringstream workers(outcome.out);
  int count = 0;
  for (pid_t worker = 0; workers >> worker; ++count) {
    // A dead process may stay in the list as a zombie until its new parent asks for it. On a busy machine the
    // coordinator itself takes a while to go.
    std::string state;
    const bool is_gone = eventually([&] {
      state = content("/proc/" + std::to_string(worker) + "/stat");
      return state.empty() || state.find(") Z ") != std::string::npos;
    });
    EXPECT_TRUE(is_gone) << state;
  }
  EXPECT_EQ(count, 2);
}

TEST_F(RunTest, PointFollowsAPath) {
  write(directory() / "path.csv", "# two increments\nh22,h11\n-1e-3,0\n-1e-3,5e-4\n");
  const Outcome outcome = polargrain("point case.yaml sand path.csv -o point.csv");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const std::vector<double> s22 = column("point.csv", "s22");
  ASSERT_EQ(s22.size(), 3u);
  // lam = 40 MPa, G = 40 MPa.
  EXPECT_NEAR(s22[0], -100e3, 1e-9);
  EXPECT_NEAR(s22[1], -100e3 - 120e6 * 1e-3, 1e-9);
  EXPECT_NEAR(s22[2], -100e3 - 120e6 * 2e-3 + 40e6 * 5e-4, 1e-9);
  EXPECT_NE(result("point.csv").find(",good,"), std::string::npos);
  const Outcome again = polargrain("point case.yaml sand path.csv");
  EXPECT_EQ(again.out, result("point.csv"));
}

TEST_F(RunTest, PointSaysWhereAPathFails) {
  set_script("fail_beyond 1e-2");
  write(directory() / "path.csv", "h11\n1e-3\n0.1\n1e-3\n");
  const Outcome outcome = polargrain("point case.yaml sand path.csv -o point.csv");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(("\n" + outcome.errors).find("\nerror: increment 2 failed: the box collapsed\n"),
            std::string::npos)
      << outcome.errors;
  EXPECT_NE(result("point.csv").find("\n2,0,0,0,0,0,0,0,failed,"), std::string::npos) << result("point.csv");
}

TEST_F(RunTest, PointReportsABadPath) {
  // The rows of a table whose columns are unknown say nothing: only the header is reported.
  write(directory() / "path.csv", "h11,h13\n1e-3,x\n1\n");
  const Outcome header = polargrain("point case.yaml sand path.csv");
  EXPECT_EQ(header.status, 2);
  EXPECT_EQ(header.errors,
            "path.csv:1: there is no column 'h13'; expected names out of h11, h12, h21, h22, w, k1, k2\n");
  write(directory() / "path.csv", "h11,h22\n1e-3,x\n1\n");
  const Outcome rows = polargrain("point case.yaml sand path.csv");
  EXPECT_EQ(rows.status, 2);
  EXPECT_EQ(rows.errors,
            "path.csv:2: expected a number, found 'x'\n"
            "path.csv:3: a value for each of 2 columns ('h11,h22', line 1) was expected, and one is here\n");
  write(directory() / "path.csv", "h11\n1e-3\n");
  EXPECT_EQ(polargrain("point case.yaml gravel path.csv").errors,
            "case.yaml: has no material 'gravel'; it has sand\n");
}

}  // namespace
}  // namespace polargrain::testing
