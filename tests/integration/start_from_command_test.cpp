// SPDX-License-Identifier: GPL-2.0-or-later
// A run that starts from the end of another, by the program: directories, profiles, runs that have not come to their end.
#include <gtest/gtest.h>

#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::string kProgram = POLARGRAIN;

std::string block(const std::string& load, const std::string& more = "") {
  return "title: A block\n"
         "continuum: cauchy\n"
         "mesh: {rectangle: {size: [1 m, 1 m], elements: [2, 2]}}\n"
         "materials: {soil: {model: elastoplastic, E: 30 MPa, nu: 0.3, friction_angle: 30 deg, dilatancy_angle: 2 deg, "
         "cohesion: 10 kPa}}\n"
         "regions: {all: soil}\n"
         "boundary: [{on: bottom, fix: [u1, u2]}, {on: top, pressure: " +
         load +
         "}]\n"
         "steps: {count: 4, tolerance: 1e-8, cut: 2}\n"
         "monitors: {top: {on: top, displacement: u2}}\n"
         "profiles: {axis: {from: [0.5 m, 0], to: [0.5 m, 1 m], points: 3, values: [s22]}}\n"
         "output: {every: 1}\n" +
         more;
}

std::string replaced_in(std::string text, const std::string& good, const std::string& bad) {
  const std::size_t place = text.find(good);
  EXPECT_NE(place, std::string::npos) << good;
  return place == std::string::npos ? text : text.replace(place, good.size(), bad);
}

class StartFromCommand : public ::testing::Test {
 protected:
  StartFromCommand() : scratch_("start_from_command") {
    write(scratch_.path() / "first.yaml", block("[[0, 0], [1, 20 kPa]]"));
    write(scratch_.path() / "second.yaml", block("[[0, 20 kPa], [1, 25 kPa]]", "start_from: first\n"));
  }
  Outcome program(const std::string& line) { return run_in(scratch_.path(), kProgram + " " + line); }

  Scratch scratch_;
};

TEST_F(StartFromCommand, DoesNotEraseItsStart) {
  ASSERT_EQ(program("run first.yaml -o first --quiet").status, 0);
  const std::string before = content(scratch_.path() / "first/history.csv");
  const Outcome refused = program("run second.yaml -o ./first/ --quiet");
  EXPECT_EQ(refused.status, 2) << refused.errors;
  EXPECT_NE(refused.errors.find("second.yaml: start_from: ./first/ is the result directory of this run too"),
            std::string::npos)
      << refused.errors;
  EXPECT_EQ(content(scratch_.path() / "first/history.csv"), before);
  EXPECT_EQ(program("run second.yaml -o second --quiet").status, 0);
}

// States of structures go over by their order: one that is left out would give its state to the next.
TEST_F(StartFromCommand, OtherStructuresAreAFault) {
  const std::string low = "low: {from: bottom_right, to: [4 m, 0 m], EA: 10 MN/m}";
  const std::string up = "up: {from: top_right, to: [4 m, 1 m], EA: 10 MN/m}";
  const auto second = [&](const std::string& anchors) {
    write(scratch_.path() / "second.yaml",
          block("[[0, 20 kPa], [1, 25 kPa]]", "anchors: {" + anchors + "}\nstart_from: first\n"));
    return program("check second.yaml");
  };
  write(scratch_.path() / "first.yaml",
        block("[[0, 0], [1, 20 kPa]]", "anchors: {" + low + ", " + up + "}\n"));
  ASSERT_EQ(program("run first.yaml -o first --quiet").status, 0);
  const Outcome refused = second(up);
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(
      (refused.out + refused.errors)
          .find(
              "start_from: 'first' ends with the anchor 'low', the anchor 'up', and this case has the anchor 'up'"),
      std::string::npos)
      << refused.out << refused.errors;
  EXPECT_EQ(second(low + ", " + up).status, 0);
}

TEST_F(StartFromCommand, GroundThatHasGoneIsAFault) {
  const auto dug = [&](const std::string& load, const std::string& regions, const std::string& steps) {
    std::string text = replaced_in(block(load), "elements: [2, 2]}",
                                   "elements: [2, 2], regions: {cap: [0, 0.5 m, 1 m, 1 m]}}");
    text = replaced_in(text, "regions: {all: soil}", "regions: {" + regions + "}");
    text = replaced_in(text, ", {on: top, pressure: " + load + "}", "");
    return replaced_in(text, "count: 4, ", steps);
  };
  const std::string dig = "stages: [{name: dig, remove: cap, count: 1}], ";
  write(scratch_.path() / "first.yaml", dug("1 kPa", "cap: soil, rest: soil", dig));
  write(scratch_.path() / "second.yaml",
        dug("1 kPa", "cap: soil, rest: soil", "count: 1, ") + "start_from: first\n");
  const Outcome first = program("run first.yaml -o first --quiet");
  ASSERT_EQ(first.status, 0) << first.errors;
  const Outcome refused = program("check second.yaml");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE((refused.out + refused.errors).find("region 'cap' had been removed at the end of 'first'"),
            std::string::npos)
      << refused.out << refused.errors;
  // Without the ground that had gone nothing is cut off.
  std::string left = replaced_in(dug("1 kPa", "rest: soil", "count: 1, "), "{cap:", "{void:");
  left = replaced_in(replaced_in(left, "{on: top,", "{on: left,"), "to: [0.5 m, 1 m]", "to: [0.5 m, 0.5 m]");
  write(scratch_.path() / "second.yaml", left + "start_from: first\n");
  const Outcome taken = program("check second.yaml");
  EXPECT_EQ(taken.status, 0) << taken.errors;
  EXPECT_EQ(taken.out.find("is left out has carried"), std::string::npos) << taken.out;
}

TEST_F(StartFromCommand, ARunThatFailedIsRemarked) {
  write(scratch_.path() / "first.yaml", block("[[0, 0], [1, 60 kPa]]"));
  ASSERT_EQ(program("run first.yaml -o first --quiet").status, 1);
  const std::string remark = "the run in 'first' has not come to its end";
  EXPECT_NE(program("check second.yaml").out.find(remark + " (status 'failed')"), std::string::npos);
  std::filesystem::remove(scratch_.path() / "first/summary.json");  // as of a killed run
  EXPECT_NE(program("check second.yaml").out.find(remark + ": "), std::string::npos);
  write(scratch_.path() / "first.yaml", block("[[0, 0], [1, 20 kPa]]"));
  ASSERT_EQ(program("run first.yaml -o first --quiet").status, 0);
  EXPECT_EQ(program("check second.yaml").out.find(remark), std::string::npos);
}

// Ground under its weight, 20 kPa a metre, and 2 kPa: the stress grows tenfold within the half metre of an element.
TEST_F(StartFromCommand, ALoadFarFromThatOfTheRunIsRemarked) {
  const auto ground = [](const std::string& load, const std::string& factor, const std::string& more) {
    return replaced_in(block(load, "body: [{unit_weight: 20 kN/m3" + factor + "}]\n" + more),
                       "fix: [u1, u2]}", "fix: [u2]}, {on: [left, right], fix: [u1]}");
  };
  write(scratch_.path() / "first.yaml", ground("[[0, 0], [1, 2 kPa]]", ", factor: [[0, 0], [1, 1]]", ""));
  const Outcome first = program("run first.yaml -o first --quiet");
  ASSERT_EQ(first.status, 0) << first.errors;
  const auto second = [&](const std::string& load) {
    write(scratch_.path() / "second.yaml",
          ground("[[0, " + load + "], [1, 8 kPa]]", "", "start_from: first\n"));
    const Outcome checked = program("check second.yaml");
    EXPECT_EQ(checked.status, 0) << checked.errors;
    return checked.out;
  };
  EXPECT_NE(second("5 kPa").find(
                "second.yaml:6: start_from: 'top' carries 5 kPa at time zero, and 'first' has left "
                "2 kPa behind it"),
            std::string::npos)
      << second("5 kPa");
  EXPECT_NE(second("0.9 kPa").find("'top' carries 900 Pa at time zero, and 'first' has left 2 kPa"),
            std::string::npos)
      << second("0.9 kPa");
  for (const char* const load :
       {"2 kPa", "3 kPa", "0"})  // nothing on a free surface: a run may have dug it free
    EXPECT_EQ(second(load).find("has left"), std::string::npos) << second(load);
}

TEST_F(StartFromCommand, ProfilesOfAnEarlierRunAreGone) {
  ASSERT_EQ(program("run first.yaml -o first --quiet --set steps.count=6").status, 0);
  ASSERT_TRUE(std::filesystem::exists(scratch_.path() / "first/profiles/axis-00006.csv"));
  ASSERT_EQ(program("run first.yaml -o first --quiet").status, 0);
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "first/profiles/axis-00006.csv"));
  EXPECT_TRUE(std::filesystem::exists(scratch_.path() / "first/profiles/axis-00004.csv"));
}

// Between smooth sides s11 = nu / (1 - nu) s22: 2/3 and 1/9 of 100 kPa. The mean of both is the stress of neither.
TEST_F(StartFromCommand, AProfileHasARowForEachSideOfABorder) {
  write(
      scratch_.path() / "layers.yaml",
      "title: Two layers\ncontinuum: cauchy\n"
      "mesh: {rectangle: {size: [1 m, 1 m], elements: [2, 2], regions: {upper: [0, 0.5 m, 1 m, 1 m]}}}\n"
      "materials: {stiff: {model: elastic, E: 20 MPa, nu: 0.1}, soft: {model: elastic, E: 20 MPa, nu: 0.4}}\n"
      "regions: {upper: stiff, rest: soft}\n"
      "boundary: [{on: [left, right], fix: [u1]}, {on: bottom, fix: [u1, u2]}, {on: top, pressure: [[0, 0], [1, "
      "100 kPa]]}]\n"
      "steps: {count: 1, tolerance: 1e-9}\nmonitors: {base: {on: bottom, reaction: u2}}\n"
      "profiles:\n  up: {from: [0.5 m, 0], to: [0.5 m, 1 m], points: 3, values: [s11, u2]}\n"
      "  down: {from: [0.5 m, 1 m], to: [0.5 m, 0], points: 3, values: [s11]}\n");
  const Outcome run = program("run layers.yaml -o layers --quiet");
  ASSERT_EQ(run.status, 0) << run.errors;
  const CsvTable up(scratch_.path() / "layers/profiles/up-00001.csv");
  ASSERT_EQ(up.rows(), 4U);
  EXPECT_EQ(up.numbers("distance"), (std::vector<double>{0.0, 0.5, 0.5, 1.0}));
  EXPECT_NEAR(up.numbers("s11")[1], -100e3 * 2.0 / 3.0, 1e-3);
  EXPECT_NEAR(up.numbers("s11")[2], -100e3 / 9.0, 1e-3);
  EXPECT_NEAR(up.numbers("u2")[1], up.numbers("u2")[2], 1e-15);
  const CsvTable down(scratch_.path() / "layers/profiles/down-00001.csv");
  ASSERT_EQ(down.rows(), 4U);
  EXPECT_NEAR(down.numbers("s11")[1], -100e3 / 9.0, 1e-3);
}

// Found before the run begins.
TEST_F(StartFromCommand, APlaneHasNoStateForSpace) {
  ASSERT_EQ(program("run first.yaml -o first --quiet").status, 0);
  write(
      scratch_.path() / "second.yaml",
      "title: a block in space\ncontinuum: cauchy\nmesh: {box: {size: [1 m, 1 m, 1 m], elements: [1, 1, 1]}}\n"
      "materials: {soil: {model: elastic, E: 10 MPa, nu: 0.25}}\nregions: {all: soil}\n"
      "boundary: [{on: bottom, fix: [u1, u2, u3]}]\nsteps: {count: 1}\nstart_from: first\n");
  const Outcome refused = program("check second.yaml");
  EXPECT_EQ(refused.status, 2) << refused.out;
  EXPECT_NE((refused.out + refused.errors).find("'first': its body is of another dimension"),
            std::string::npos)
      << refused.out << refused.errors;
}

}  // namespace
}  // namespace polargrain::testing
