// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies in space through the commands: a law against its closed form, boxes of spheres, mistakes in the case.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "common/csv_table.hpp"
#include "tests/faults/checkpoint_runs.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::string kProgram = POLARGRAIN;

std::string law_case(const std::string& mesh, const std::string& material) {
  return "title: Triaxial compression\n"
         "mesh: {box: {size: [0.1 m, 0.1 m, 0.2 m], elements: " +
         mesh +
         "}\n"
         "materials: {sand: {model: elastoplastic, E: 50 MPa, nu: 0.25, Gc: 20 MPa, lc: 5 mm, friction_angle: 30 deg, "
         "dilatancy_angle: 5 deg, cohesion: 0.1 kPa, confining: 100 kPa" +
         material +
         "}}\n"
         "regions: {all: sand}\n"
         "boundary:\n"
         "  - {on: bottom, fix: [u3]}\n"
         "  - {on: bottom_front_left, fix: [u1, u2]}\n"
         "  - {on: bottom_front_right, fix: [u2]}\n"
         "  - {on: top, move: {u3: -6 mm}}\n"
         "  - {on: [left, right, front, back], pressure: 100 kPa}\n"
         "steps: {count: 6, tolerance: 1e-9}\n"
         "monitors: {force: {on: top, reaction: u3}}\n";
}

class SpaceRun : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path folder() const { return scratch_.path(); }
  [[nodiscard]] double last_force(const std::string& results) const {
    const CsvTable table(folder() / results / "history.csv");
    return table.number(table.rows() - 1, table.column("force"));
  }
  Scratch scratch_{"space_run"};
};

// (sigma_1 + c cot phi) = Kp (sigma_3 + c cot phi), over 0.01 m^2; of the cone in extension by its own M.
TEST_F(SpaceRun, ALawCarriesItsTriaxialStrength) {
  const double coefficient = std::pow(std::tan(M_PI / 4.0 + M_PI / 12.0), 2);
  const double expected = -(coefficient * 100e3 + 2.0 * 100.0 * std::sqrt(coefficient)) * 0.01;
  for (const std::string mesh : {"[1, 1, 2]}", "[1, 1, 2]}, element: H8", "[1, 1, 1]}, element: T10"}) {
    write(folder() / "case.yaml", law_case(mesh, ""));
    const Outcome run = run_in(folder(), kProgram + " run case.yaml -o law --quiet");
    ASSERT_EQ(run.status, 0) << run.errors;
    EXPECT_NEAR(last_force("law") / expected, 1.0, 1e-8) << mesh;
    std::filesystem::remove_all(folder() / "law");
  }
  const Outcome report = run_in(folder(), kProgram + " run case.yaml -o law --quiet && " + kProgram +
                                              " report law && " + kProgram + " verify law");
  EXPECT_EQ(report.status, 0) << report.errors;
  EXPECT_NE(content(folder() / "law" / "report.html").find("body in space"), std::string::npos);
  EXPECT_NE(content(folder() / "law" / "summary.json").find("\"unit\": \"N\""), std::string::npos);
}

/// What `check` says of a case with something replaced.
std::string faults_of(const std::filesystem::path& folder, std::string text, const std::string& from,
                      const std::string& to) {
  const auto place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  text.replace(place, from.size(), to);
  write(folder / "case.yaml", text);
  const Outcome outcome = run_in(folder, kProgram + " check case.yaml");
  EXPECT_NE(outcome.status, 0);
  return outcome.errors;
}

TEST_F(SpaceRun, MistakesAreToldWithLineAndRemedy) {
  const std::string good = law_case("[1, 1, 2]}", "");
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& words) {
    const std::string told = faults_of(folder(), good, from, to);
    EXPECT_NE(told.find(words), std::string::npos) << told;
    EXPECT_NE(told.find("case.yaml:"), std::string::npos) << told;
  };
  expect("fix: [u3]", "fix: [w]", "fix: expected one of u1, u2, u3, w1, w2, w3, found 'w'");
  expect("lc: 5 mm", "lc: 0 mm", "must be above zero in space");
  expect("model: elastoplastic", "model: informed",
         "has no elements in space yet; there are elastic, elastoplastic, cell");
  expect("[1, 1, 2]", "[1, 1]", "elements");
  expect("fix: [u1, u2]", "fix: [u2]", "translation along 1");
  expect("{on: bottom_front_right, fix: [u2]}", "{on: bottom, fix: [u3]}",
         "rotation about an axis along 3 through (0, 0, 0.1)");
  expect("elements: [1, 1, 2]}", "elements: [1, 1, 2]}, element: Q8R", "H20R");
  expect("top, reaction: u3", "top, reaction: u4", "u3");
}

// One element of boxes of spheres: the same bytes with one and two workers, and for a run that was killed.
TEST_F(SpaceRun, BoxesOfSpheresGiveTheSameBytes) {
  write(folder() / "spheres.yaml",
        "grains: 100\nsizes: {law: uniform, radius: [4 mm, 6 mm]}\ndensity: 2650\ndimension: 3\n"
        "script: cells/spheres_hooke_radii.in\npressure: 100 kPa\nfriction: 0.2\nseed: 5\n");
  const Outcome made = run_in(folder(), kProgram + " pack spheres.yaml -o spheres.h5");
  ASSERT_EQ(made.status, 0) << made.errors;
  write(
      folder() / "case.yaml",
      "title: One element of spheres in space\n"
      "mesh: {box: {size: [0.1 m, 0.1 m, 0.1 m], elements: [1, 1, 1]}}\n"
      "materials: {sand: {model: cell, script: cells/spheres_hooke_radii.in, packing: spheres.h5, lc: 20 mm}}\n"
      "regions: {all: sand}\n"
      "boundary:\n"
      "  - {on: bottom, fix: [u3]}\n"
      "  - {on: left, fix: [u1]}\n"
      "  - {on: front, fix: [u2]}\n"
      "  - {on: top, move: {u3: -0.5 mm}}\n"
      "  - {on: [right, back], pressure: 100 kPa}\n"
      "steps: {count: 4, tolerance: 2e-2}\n"
      "monitors: {force: {on: top, reaction: u3}}\n");
  const Outcome one = run_in(folder(), kProgram + " run case.yaml -o one -w 1 --quiet");
  ASSERT_EQ(one.status, 0) << one.errors;
  const Outcome two = run_in(folder(), kProgram + " run case.yaml -o two -w 2 --quiet");
  ASSERT_EQ(two.status, 0) << two.errors;
  EXPECT_EQ(content(folder() / "one" / "history.csv"), content(folder() / "two" / "history.csv"));
  {
    RunningProgram program(folder(), "run case.yaml -o killed -w 1 --quiet --checkpoint-minutes 0");
    await(program, [&] { return std::filesystem::exists(folder() / "killed" / "checkpoint.h5"); });
    program.end(SIGKILL);
  }
  const Outcome resumed = run_in(folder(), kProgram + " run case.yaml -o killed -w 1 --quiet --resume");
  ASSERT_EQ(resumed.status, 0) << resumed.errors;
  EXPECT_EQ(content(folder() / "one" / "history.csv"), content(folder() / "killed" / "history.csv"));
  EXPECT_LT(last_force("one"), -1.5 * 100e3 * 0.01);  // it carries more than its confining pressure
  const Outcome verified = run_in(folder(), kProgram + " verify one");
  EXPECT_EQ(verified.status, 0) << verified.out << verified.errors;
}

}  // namespace
}  // namespace polargrain::testing
