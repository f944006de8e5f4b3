// SPDX-License-Identifier: GPL-2.0-or-later
// A packing of spheres in space through the commands: pack, check, point, run, and a run that is killed and goes on.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <string>
#include <utility>

#include "common/csv_table.hpp"
#include "tests/faults/checkpoint_runs.hpp"
#include "tests/integration/command.hpp"
#include "tests/integration/replay_reports.hpp"

namespace polargrain::testing {
namespace {

const std::string kProgram = POLARGRAIN;

/// A hundred spheres, made with friction, so that tangential forces lie ready in them.
constexpr const char* kSpecification =
    "grains: 100\nsizes: {law: uniform, radius: [4 mm, 6 mm]}\ndensity: 2650\ndimension: 3\n"
    "script: cells/spheres_hooke_radii.in\npressure: 100 kPa\nfriction: 0.2\nseed: 5\n";

/// One element in plane strain between smooth plates.
std::string case_text(const std::string& material) {
  return "title: One element of spheres\n"
         "mesh: {rectangle: {size: [0.4 m, 0.4 m], elements: [1, 1]}}\n"
         "materials: {sand: {script: cells/spheres_hooke_radii.in, packing: spheres.h5, " +
         material +
         "}}\n"
         "regions: {all: sand}\n"
         "boundary:\n"
         "  - {on: bottom, fix: [u2]}\n"
         "  - {on: bottom_left, fix: [u1]}\n"
         "  - {on: top, move: {u2: -2 mm}}\n"
         "  - {on: [left, right], pressure: 100 kPa}\n"
         "steps: {count: 5, tolerance: 1e-2}\n"
         "monitors: {top_force: {on: top, reaction: u2}}\n"
         "output: {every: 1}\n";
}

class SphereRun : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = new Scratch("sphere_run");
    write(scratch_->path() / "spheres.yaml", kSpecification);
    made_ = run_in(scratch_->path(), kProgram + " pack spheres.yaml -o spheres.h5");
  }
  static void TearDownTestSuite() {
    delete scratch_;
    scratch_ = nullptr;
  }
  void SetUp() override {
    ASSERT_EQ(made_.status, 0) << made_.errors;
    write(folder() / "case.yaml", case_text("model: cell, lc: 20 mm"));
  }
  static const std::filesystem::path& folder() { return scratch_->path(); }

  /// Leads a point along path.csv and replays its way with the engine alone: the same digits.
  static void expect_replay(const std::string& name) {
    const Outcome walked =
        run_in(folder(), kProgram + " point case.yaml sand path.csv -o answers.csv --replay " + name);
    ASSERT_EQ(walked.status, 0) << walked.errors;
    const Outcome replayed = run_in(folder() / name, POLARGRAIN_LIGGGHTS " -in in.replay -log none");
    ASSERT_EQ(replayed.status, 0) << replayed.out << replayed.errors;
    EXPECT_EQ(replay_reports(content(folder() / name / "README.md")), replay_reports(replayed.out));
    EXPECT_EQ(replay_reports(replayed.out).size(), 2u);
  }

  /// Runs case.yaml whole, and once more killed behind its first checkpoint and resumed: the same bytes.
  static void expect_resumed_alike(const std::string& prefix) {
    const std::string whole = prefix + "whole";
    const std::string killed = prefix + "killed";
    const Outcome run = run_in(folder(), kProgram + " run case.yaml -o " + whole + " -w 2 --quiet");
    ASSERT_EQ(run.status, 0) << run.errors;
    {
      RunningProgram program(folder(), "run case.yaml -o " + killed + " -w 1 --quiet --checkpoint-minutes 0");
      await(program, [&] { return std::filesystem::exists(folder() / killed / "checkpoint.h5"); });
      program.end(SIGKILL);
    }
    ASSERT_TRUE(std::filesystem::exists(folder() / killed / "checkpoint.h5"));
    const Outcome resumed =
        run_in(folder(), kProgram + " run case.yaml -o " + killed + " -w 2 --quiet --resume");
    ASSERT_EQ(resumed.status, 0) << resumed.errors;
    EXPECT_TRUE(results_of(folder() / whole) == results_of(folder() / killed));
  }

  static Scratch* scratch_;
  static Outcome made_;
};
Scratch* SphereRun::scratch_ = nullptr;
Outcome SphereRun::made_;

TEST_F(SphereRun, CheckNamesTheModuliOfThePacking) {
  EXPECT_NE(made_.out.find("moduli of the packing at rest: G "), std::string::npos) << made_.out;
  const Outcome checked = run_in(folder(), kProgram + " check case.yaml");
  EXPECT_EQ(checked.status, 0) << checked.errors;
  EXPECT_NE(checked.out.find("moduli of the packing at rest: G "), std::string::npos) << checked.out;
}

TEST_F(SphereRun, PointKnowsTheStressNormalToThePlane) {
  write(folder() / "path.csv", "h11,h22\n5e-4,-5e-4\n5e-4,-5e-4\n");
  const Outcome walked = run_in(folder(), kProgram + " point case.yaml sand path.csv -o answers.csv");
  ASSERT_EQ(walked.status, 0) << walked.errors;
  const CsvTable answers(folder() / "answers.csv");
  ASSERT_EQ(answers.rows(), 3u);
  // At rest an isotropic pressure, to the tolerance of the packing; then the intermediate stress of plane strain.
  EXPECT_NEAR(answers.number(0, 3) / -100e3, 1.0, 2e-3);
  const double s11 = answers.number(2, 1);
  const double s22 = answers.number(2, 2);
  const double s33 = answers.number(2, 3);
  EXPECT_LT(s22, s33);
  EXPECT_LT(s33, s11);
}

TEST_F(SphereRun, AReplayPrintsTheSameDigits) {
  write(folder() / "path.csv", "h11,h12,h22\n5e-4,2e-4,-5e-4\n-5e-4,0,5e-4\n");
  expect_replay("way");
}

TEST_F(SphereRun, ARunThatWasKilledGoesOnToTheSameBytes) {
  expect_resumed_alike("");
}

TEST_F(SphereRun, AdaptiveAndInformedTakeSpheresToo) {
  for (const char* model : {"adaptive", "informed"}) {
    write(folder() / "case.yaml", case_text(std::string("model: ") + model + ", lc: 20 mm"));
    const Outcome run = run_in(folder(), kProgram + " run case.yaml -w 2 --quiet -o " + model);
    EXPECT_EQ(run.status, 0) << model << ": " << run.errors;
  }
}

TEST_F(SphereRun, AnInformedLawOfSpheresIsAsStrongAsItsCell) {
  std::string path = "h11,h22\n";
  for (int step = 0; step < 15; ++step) path += "5e-4,-1e-3\n";
  write(folder() / "path.csv", path);
  const auto last_ratio = [](const std::string& model) {
    write(folder() / "case.yaml", case_text("model: " + model + ", lc: 20 mm"));
    const Outcome walked = run_in(folder(), kProgram + " point case.yaml sand path.csv -o " + model + ".csv");
    EXPECT_EQ(walked.status, 0) << model << ": " << walked.errors;
    const CsvTable answers(folder() / (model + ".csv"));
    return answers.number(15, 2) / answers.number(15, 1);
  };
  const double cell = last_ratio("cell");
  const double law = last_ratio("informed");
  std::cout << "[figure] stress ratio at 1.5 %: cell " << cell << ", informed " << law << '\n';
  EXPECT_GT(cell, 1.8);
  // The law is one step late. With an intermediate stress that was matched as well it came to 12 % more.
  EXPECT_NEAR(law / cell, 1.0, 0.05);
}

TEST_F(SphereRun, PointsThatHaveLeftTheirLawGoOnToTheSameBytes) {
  write(folder() / "case.yaml",
        case_text("model: informed, informed: {beyond_mismatch: cell, mismatch_limit: 5 %}, lc: 20 mm"));
  expect_resumed_alike("left_law_");
  EXPECT_EQ(content(folder() / "left_law_whole/summary.json").find("\"stress_of_cell\": 0.0"),
            std::string::npos);
}

TEST_F(SphereRun, ControlledRotationsThroughEveryCommand) {
  // Rolling resistance with torsion, the couple stress of the grains, no lc; a packing made under the same script.
  const std::string sand = "rotations: controlled, ";
  const auto with_li_chu = [](std::string text) {
    for (const auto& [word, other] : {std::pair<std::string, std::string>("hooke_radii", "li_chu"),
                                      std::pair<std::string, std::string>("spheres.h5", "turned.h5")})
      if (const auto place = text.find(word); place != std::string::npos)
        text.replace(place, word.size(), other);
    return text;
  };
  write(folder() / "turned.yaml", with_li_chu(kSpecification));
  const Outcome packed = run_in(folder(), kProgram + " pack turned.yaml -o turned.h5");
  ASSERT_EQ(packed.status, 0) << packed.errors;
  write(folder() / "case.yaml", with_li_chu(case_text(sand + "model: cell")));
  write(folder() / "path.csv",
        "h11,h12,h22,w,k1,k2\n5e-4,2e-4,-5e-4,1e-3,0.05,-0.02\n-5e-4,0,5e-4,0,0,0.1\n");
  ASSERT_NO_FATAL_FAILURE(expect_replay("turned"));
  const CsvTable answers(folder() / "answers.csv");
  EXPECT_GT(std::abs(answers.number(2, answers.column("m1"))), 0.0);

  ASSERT_NO_FATAL_FAILURE(expect_resumed_alike("turned_"));
  for (const char* model : {"adaptive", "informed"}) {
    write(folder() / "case.yaml", with_li_chu(case_text(sand + "model: " + model)));
    const Outcome run = run_in(folder(), kProgram + " run case.yaml -w 2 --quiet -o turned_" + model);
    EXPECT_EQ(run.status, 0) << model << ": " << run.errors;
  }
}

TEST_F(SphereRun, WhatSpheresCannotDoIsRefused) {
  // A script for discs.
  const Outcome plane = run_in(folder(), kProgram +
                                             " run case.yaml -o plane -w 1 --quiet --set "
                                             "materials.sand.script=cells/hooke_radii.in");
  EXPECT_EQ(plane.status, 2);
  EXPECT_NE(
      plane.errors.find(
          "the script is for discs in a plane (dimension 2), and the packing is one of spheres in space"),
      std::string::npos)
      << plane.errors;
}

}  // namespace
}  // namespace polargrain::testing
