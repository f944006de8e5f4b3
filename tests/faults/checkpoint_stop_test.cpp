// SPDX-License-Identifier: GPL-2.0-or-later
// Runs that are stopped in good order and go on; checkpoints that must not be used.
#include <gtest/gtest.h>

#include "tests/faults/checkpoint_runs.hpp"

namespace polargrain::testing {
namespace {

class StoppedRun : public ::testing::Test {
 protected:
  StoppedRun()
      : scratch_(std::string("checkpoint_") +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    write_case(scratch_.path(), {"sleep_milliseconds 4"});
  }

  [[nodiscard]] Outcome polargrain(const std::string& arguments) const {
    return run_in(scratch_.path(), POLARGRAIN " " + arguments);
  }
  [[nodiscard]] std::string result(const std::string& file) const { return content(scratch_.path() / file); }
  /// Rows of out/history.csv, that of the names included.
  [[nodiscard]] long rows() const { return rows_of(scratch_.path() / "out/history.csv"); }
  /// Starts a run into out/, and sends a signal behind `steps` committed steps. @returns the exit status
  int stop_behind(int steps, int signal) const {
    const auto program = frozen_behind(scratch_.path(), steps, "-w 2");
    kill(program->id(), signal);
    return program->end(SIGCONT);
  }

  Scratch scratch_;
};

/// Said where the last checkpoint of a run that was stopped behind its first steps cannot be used.
const std::string kTheOneBefore =
    "the checkpoint before it, out/checkpoint.before.h5, is of step 0 and can be read: to go on from there, "
    "'mv out/checkpoint.before.h5 out/checkpoint.h5' and run with --resume again\n";

TEST_F(StoppedRun, SaysHowToGoOnAndGoesOnToTheSameBytes) {
  ASSERT_EQ(polargrain("run case.yaml -o whole -w 2 --quiet").status, 0);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    std::filesystem::remove_all(scratch_.path() / "out");
    EXPECT_EQ(stop_behind(3, signal), 3);
    const std::string said = result("program.out");
    EXPECT_EQ(said.find(signal == SIGTERM  ? "stopped by SIGTERM\n"
                        : signal == SIGINT ? "stopped by SIGINT\n"
                                           : "stopped by SIGHUP\n"),
              0u)
        << said;
    const long step = rows() - 2;
    EXPECT_NE(said.find("checkpoint: the last one is of step " + std::to_string(step) +
                        " of 10; to go on:\n  polargrain run case.yaml -o out --resume\n"),
              std::string::npos)
        << said;
    EXPECT_NE(result("out/summary.json").find("\"status\": \"stopped\""), std::string::npos);
    // Another number of workers than before.
    const Outcome rest = polargrain("run case.yaml -o out -w 1 --resume");
    EXPECT_EQ(rest.status, 0) << rest.errors;
    EXPECT_NE(rest.out.find("going on behind step " + std::to_string(step) + " of 10"), std::string::npos);
    EXPECT_TRUE(results_of(scratch_.path() / "out") == results_of(scratch_.path() / "whole"));
    // The whole run counts in the table and in the summary, not only what came after the stop.
    EXPECT_NE(result("out/summary.json").find("\"steps_committed\": 10"), std::string::npos);
    EXPECT_NE(rest.out.find("\n     1  "), std::string::npos) << rest.out;
  }
}

TEST_F(StoppedRun, ThatIsDoneHasNothingToGoOnWith) {
  ASSERT_EQ(polargrain("run case.yaml -o out -w 2 --quiet").status, 0);
  const std::string before = results_of(scratch_.path() / "out");
  const auto what_materials_say = [this] {
    const std::string summary = result("out/summary.json");
    const std::size_t begin = summary.find("\"materials\"");
    return summary.substr(begin, summary.find("\"proof\"") - begin);
  };
  const std::string said = what_materials_say();
  EXPECT_NE(said.find("\"all\""), std::string::npos) << said;
  const Outcome again = polargrain("run case.yaml -o out -w 2 --resume");
  EXPECT_EQ(again.status, 0) << again.errors;
  EXPECT_NE(again.out.find("going on behind step 10 of 10"), std::string::npos);
  EXPECT_TRUE(results_of(scratch_.path() / "out") == before);
  EXPECT_NE(result("out/summary.json").find("\"status\": \"done\""), std::string::npos);
  EXPECT_EQ(what_materials_say(), said);
}

TEST_F(StoppedRun, ResumeWithoutACheckpointIsRefused) {
  const Outcome nothing = polargrain("run case.yaml -o out --resume");
  EXPECT_EQ(nothing.status, 2);
  EXPECT_EQ(nothing.errors,
            "out: holds no run to go on with; name its directory with -o DIR, or run without --resume\n");
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "out"));
  EXPECT_EQ(stop_behind(1, SIGTERM), 3);
  std::filesystem::remove(scratch_.path() / "out/checkpoint.h5");
  EXPECT_EQ(polargrain("run case.yaml -o out --resume").errors,
            "out/checkpoint.h5: there is no checkpoint to go on from; " + kTheOneBefore);
  std::filesystem::remove(scratch_.path() / "out/checkpoint.before.h5");
  EXPECT_EQ(polargrain("run case.yaml -o out --resume").errors,
            "out/checkpoint.h5: there is no checkpoint to go on from; run without --resume\n");
}

TEST_F(StoppedRun, ACheckpointOfAnotherCaseIsRefusedWithWhatDiffers) {
  EXPECT_EQ(stop_behind(1, SIGTERM), 3);
  const std::string history = result("out/history.csv");
  const std::string case_text = result("case.yaml");
  // Title and comments may change.
  write(scratch_.path() / "case.yaml", "# a comment\n" + case_text);
  const Outcome settings =
      polargrain("run case.yaml -o out --resume --set steps.count=20 --set materials.sand.Gc='11 MPa'");
  EXPECT_EQ(settings.status, 2);
  EXPECT_EQ(settings.errors,
            "out/checkpoint.h5: this checkpoint is of another case than case.yaml:\n"
            "  materials.sand.Gc: was '10 MPa', is '11 MPa'\n"
            "  steps.count: was '10', is '20'\n"
            "undo these changes, or run without --resume\n");
  write(scratch_.path() / "fake.in", "sleep_milliseconds 5\n");
  const Outcome script = polargrain("run case.yaml -o out --resume --set continuum=cosserat");
  EXPECT_EQ(script.status, 2);
  EXPECT_EQ(script.errors,
            "out/checkpoint.h5: this checkpoint is of another case than case.yaml:\n"
            "  continuum: was not given, is 'cosserat'\n"
            "  materials.sand.script: the file 'fake.in' has another content\n"
            "undo these changes, or run without --resume\n");
  // Nothing was touched by what was refused.
  EXPECT_EQ(result("out/history.csv"), history);
  write(scratch_.path() / "fake.in", "sleep_milliseconds 4\n");
  EXPECT_EQ(polargrain("run case.yaml -o out --resume --quiet --set title='Another title'").status, 0);
}

TEST_F(StoppedRun, ADamagedCheckpointIsRefused) {
  EXPECT_EQ(stop_behind(1, SIGTERM), 3);
  const std::filesystem::path file = scratch_.path() / "out/checkpoint.h5";
  const std::string good = content(file);
  std::string advice = kTheOneBefore;
  const auto expect_refused = [&](const std::string& bytes, const std::string& why) {
    write(file, bytes);
    const Outcome outcome = polargrain("run case.yaml -o out --resume");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.errors, "out/checkpoint.h5: this checkpoint cannot be used: " + why + "; " + advice);
  };
  const std::string cut =
      "the file is truncated, or it is not a polargrain file: the mark at its end is missing";
  const std::string damaged = "it is damaged: its content does not match the hash at its end";
  expect_refused("", cut);
  expect_refused(good.substr(0, good.size() / 2), cut);
  expect_refused(good.substr(0, good.size() - 1), cut);
  for (const std::size_t place : {std::size_t{0}, good.size() / 3, good.size() / 2, good.size() - 40}) {
    std::string bad = good;
    bad[place] = static_cast<char>(bad[place] ^ 4);
    expect_refused(bad, damaged);
  }
  const std::filesystem::path before = scratch_.path() / "out/checkpoint.before.h5";
  const std::string good_before = content(before);
  write(before, "damaged too");
  advice = "run without --resume\n";
  expect_refused("", cut);
  // The command of the advice brings the whole run.
  write(before, good_before);
  std::filesystem::rename(before, file);
  EXPECT_EQ(polargrain("run case.yaml -o out --resume --quiet").status, 0);
  ASSERT_EQ(polargrain("run case.yaml -o whole --quiet").status, 0);
  EXPECT_TRUE(results_of(scratch_.path() / "out") == results_of(scratch_.path() / "whole"));
}

TEST_F(StoppedRun, AnotherRunInTheSameDirectoryIsRefused) {
  const auto first = frozen_behind(scratch_.path(), 0, "-w 1");
  for (const char* options : {"", " --resume"}) {
    const Outcome second = polargrain(std::string("run case.yaml -o out --quiet -w 1") + options);
    EXPECT_EQ(second.status, 2);
    EXPECT_EQ(
        second.errors,
        "out: another run is at work in this directory; wait for its end, or give another with -o DIR\n");
  }
  EXPECT_EQ(first->end(SIGCONT), 0);
}

TEST_F(StoppedRun, ANewRunKeepsTheCheckpointOfAnUnfinishedOne) {
  EXPECT_EQ(stop_behind(2, SIGTERM), 3);
  const std::string old = result("out/checkpoint.h5");
  ASSERT_EQ(polargrain("run case.yaml -o out --quiet").status, 0);
  EXPECT_TRUE(result("out/checkpoint.old.h5") == old);
}

TEST_F(StoppedRun, WritesCheckpointsAsOftenAsTheCaseSays) {
  ASSERT_EQ(polargrain("run case.yaml -o every --quiet --set output.checkpoint_minutes=0").status, 0);
  ASSERT_EQ(
      polargrain("run case.yaml -o seldom --quiet --set output.checkpoint_minutes=0 --checkpoint-minutes 60")
          .status,
      0);
  const auto written = [&](const std::string& directory) {
    const std::string log = result(directory + "/run.log");
    long count = 0;
    for (std::size_t place = log.find("checkpoint of step"); place != std::string::npos;
         place = log.find("checkpoint of step", place + 1)) {
      ++count;
    }
    return count;
  };
  EXPECT_EQ(written("every"), 11);
  EXPECT_EQ(written("seldom"), 2);  // at the start and at the end
}

// Everything a solver can be asked for, stopped between any two steps: softening, arc length, large
// deformation.
TEST_F(StoppedRun, OfAnyKindGoesOnToTheSameBytes) {
  const std::string softening =
      "title: Softening under arc length\n"
      "mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [2, 4]}}\n"
      "materials:\n"
      "  sand: {model: elastoplastic, E: 100 MPa, nu: 0.25, Gc: 50 MPa, lc: 50 mm, confining: 100 kPa,\n"
      "         friction_angle: [40 deg, 30 deg], dilatancy_angle: 5 deg, cohesion: 1 kPa,\n"
      "         hardening_shear: 0.1}\n"
      "regions: {all: sand}\n"
      "boundary:\n"
      "  - {on: bottom, fix: [u1, u2]}\n"
      "  - {on: top, fix: [u1], move: {u2: [[0, 0], [1, -8 mm], [10, -80 mm]]}}\n"
      "  - {on: [left, right], pressure: 100 kPa}\n"
      "steps:\n"
      "  tolerance: 1e-6\n"
      "  iterations: 8\n"
      "  stages:\n"
      "    - {until: 0.8, count: 3}\n"
      "    - {measure: {on: top, displacement: u2}, grow: -2 mm, count: 3}\n"
      "    - {arc_length: 8 mm, count: 4}\n"
      "monitors: {top_force: {on: top, reaction: u2}}\n";
  const std::string large =
      "title: A block that is sheared far\n"
      "mesh: {rectangle: {size: [1 m, 1 m], elements: [2, 2]}}\n"
      "deformation: large\n"
      "materials: {block: {model: elastic, E: 10 MPa, nu: 0.3, Gc: 2 MPa, lc: 10 mm}}\n"
      "regions: {all: block}\n"
      "boundary:\n"
      "  - {on: bottom, fix: [u1, u2]}\n"
      "  - {on: top, move: {u1: 0.5 m, u2: -0.1 m}}\n"
      "  - {on: left, pressure: 50 kPa}\n"
      "steps: {count: 6, tolerance: 1e-6}\n"
      "monitors: {top_force: {on: top, reaction: u1}}\n";
  for (const std::string& text : {softening, large}) {
    write(scratch_.path() / "case.yaml", text);
    const Outcome whole = polargrain("run case.yaml -o whole --quiet --checkpoint-minutes 0");
    ASSERT_EQ(whole.status, 0) << whole.errors;
    const std::string expected = results_of(scratch_.path() / "whole");
    const Kills done = kill_again_and_again(scratch_.path(), "run case.yaml --quiet", 10, 7,
                                            [&](int status, const std::filesystem::path& directory) {
                                              EXPECT_EQ(status, 0) << result("program.out");
                                              EXPECT_TRUE(results_of(directory) == expected);
                                              std::filesystem::remove_all(directory);
                                            });
    EXPECT_EQ(done.kills, 10);
  }
}

}  // namespace
}  // namespace polargrain::testing
