// SPDX-License-Identifier: GPL-2.0-or-later
// A cell's way, written as a folder and gone again by polargrain-liggghts alone: the same stresses, to the
// bit.
#include "coupler/replay/replay.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <iostream>
#include <sstream>

#include "common/plane_in_space.hpp"
#include "dem/cell/cell_service.hpp"
#include "tests/integration/command.hpp"
#include "tests/integration/replay_reports.hpp"
#include "tests/support/cell_fixture.hpp"

namespace polargrain::dem {
namespace {

using polargrain::testing::Outcome;
using polargrain::testing::replay_reports;
using polargrain::testing::run_in;
using polargrain::testing::Scratch;

struct Reports {
  std::vector<std::string> expected;  ///< from the README
  std::vector<std::string> printed;   ///< by the replay
};

/// Runs a definition along a way and its replay.
Reports replayed(const CellDefinition& definition, const std::vector<Increment<2>>& path, std::size_t first) {
  const std::unique_ptr<CellService> cell = make_cell_service(definition);
  coupler::Replay replay;
  replay.reason = "A test.";
  StatePointer state;
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (k == first) replay.start = state;
    const CellReply reply = cell->evaluate({state, in_space(path[k])});
    EXPECT_EQ(reply.response.quality, Quality::good) << reply.response.message;
    state = reply.state;
    if (k < first) continue;
    replay.increments.push_back(in_space(path[k]));
    replay.answers.push_back(reply.response);
  }
  const Scratch scratch("replay");
  coupler::write_replay(scratch.path() / "folder", definition, replay);
  const Outcome outcome =
      run_in(scratch.path() / "folder", std::string(POLARGRAIN_LIGGGHTS) + " -in in.replay -log none");
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.errors;
  Reports both{replay_reports(polargrain::testing::content(scratch.path() / "folder" / "README.md")),
               replay_reports(outcome.out)};
  EXPECT_EQ(both.expected.size(), path.size() - first);
  return both;
}

/// Where the engine's own loop steps the cell too: all digits.
void expect_equal_replay(CellDefinition definition, const std::vector<Increment<2>>& path,
                         std::size_t first) {
  definition.control.loop = CellLoop::engine;
  const Reports both = replayed(definition, path, first);
  EXPECT_EQ(both.printed, both.expected);
}

/// The numbers of a report.
std::vector<double> numbers(const std::string& line) {
  std::vector<double> found;
  std::istringstream in(line);
  for (std::string word; in >> word;)
    if (word.find_first_of("0123456789") != std::string::npos) found.push_back(std::stod(word));
  return found;
}

Increment<2> increment(double h11, double h12, double h21, double h22) {
  Increment<2> made;
  made.displacement_gradient << h11, h12, h21, h22;
  return made;
}

/// Compression, then shear that turns the box.
const std::vector<Increment<2>> kPath{increment(5e-4, 0.0, 0.0, -1e-3), increment(2e-4, 4e-4, -1e-3, -5e-4),
                                      increment(1e-4, 1e-3, 2e-3, -1e-3)};

TEST(Replay, PrintsTheStressesOfTheCellFromThePackingOn) {
  expect_equal_replay(test::demo_cell(), kPath, 0);
}

TEST(Replay, PrintsTheStressesOfTheCellFromAStateOn) {
  expect_equal_replay(test::demo_cell(), kPath, 2);
}

// The loop over discs answers, and its states are what the replay starts from.
TEST(Replay, AgreesWithTheLoopOverDiscsUntilRoundOffHasGrown) {
  for (const std::size_t first : {0u, 1u}) {
    const Reports both = replayed(test::rolling_cell(1.0, 0.4), kPath, first);
    ASSERT_EQ(both.printed.size(), both.expected.size());
    for (std::size_t k = 0; k < both.printed.size(); ++k) {
      const std::vector<double> printed = numbers(both.printed[k]);
      const std::vector<double> expected = numbers(both.expected[k]);
      ASSERT_EQ(printed.size(), expected.size());
      // Of stresses of 1e5 Pa; 1e-14 of them at first, more with every contact that slides or opens earlier.
      for (std::size_t n = 0; n < printed.size(); ++n) EXPECT_NEAR(printed[n], expected[n], 0.1) << k;
    }
  }
}

// Turned by 0.1 rad and strained by -1e-3, which is what counts for the DEM steps; the symmetric part is
// -6e-3.
TEST(Replay, PrintsTheStressesAfterALargeRotation) {
  expect_equal_replay(test::demo_cell(), {increment(-6e-3, -0.0998, 0.0998, -6e-3)}, 0);
}

TEST(Replay, PrintsTheCoupleStressOfControlledRotations) {
  CellDefinition definition = test::demo_cell();
  definition.script_file = "liggghts_inputs/cells/hooke_li_chu.in";
  definition.script = test::file_text(definition.script_file);
  definition.control.rotations = CellRotations::controlled;
  std::vector<Increment<2>> path = kPath;
  path[0].micro_rotation = 1e-3;
  path[1].curvature = {0.02, -0.01};
  path[2].micro_rotation = 5e-4;
  expect_equal_replay(definition, path, 1);
}

TEST(Replay, OfARequestNeedsNoAnswer) {
  const Scratch scratch("replay_request");
  coupler::write_replay(scratch.path(), test::demo_cell(), CellRequest{nullptr, in_space(kPath[0])},
                        "The worker died: reasons.");
  const std::string readme = polargrain::testing::content(scratch.path() / "README.md");
  EXPECT_NE(readme.find("The worker died: reasons."), std::string::npos);
  EXPECT_TRUE(replay_reports(readme).empty());
  const Outcome outcome =
      run_in(scratch.path(), std::string(POLARGRAIN_LIGGGHTS) + " -in in.replay -log none");
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  EXPECT_EQ(replay_reports(outcome.out).size(), 1u);
}

/// Scripts of version 1 give the numbers of the plane alone, and no version.
TEST(Replay, OfTheFirstVersionIsRead) {
  const Scratch scratch("replay_old");
  const auto printed = [&scratch] {
    const Outcome outcome =
        run_in(scratch.path(), std::string(POLARGRAIN_LIGGGHTS) + " -in in.replay -log none");
    EXPECT_EQ(outcome.status, 0) << outcome.out;
    return replay_reports(outcome.out);
  };
  coupler::write_replay(scratch.path(), test::demo_cell(), CellRequest{nullptr, in_space(kPath[1])},
                        "A test.");
  const std::vector<std::string> now = printed();
  std::string script = polargrain::testing::content(scratch.path() / "in.replay");
  const auto replace = [&script](const std::string& from, const std::string& to) {
    const auto at = script.find(from);
    ASSERT_NE(at, std::string::npos) << script;
    script.replace(at, from.size(), to);
  };
  replace(" version 2", "");
  const auto numbers = script.find("fix_modify      cell increment ") + 31;
  script.replace(numbers, script.find('\n', numbers) - numbers, "2e-4 4e-4 -1e-3 -5e-4 0 0 0");
  polargrain::testing::write(scratch.path() / "in.replay", script);
  EXPECT_EQ(printed(), now);
  ASSERT_EQ(now.size(), 1u);
  // Discs stay in their plane.
  replace("2e-4 4e-4 -1e-3 -5e-4 0 0 0", "2e-4 4e-4 0 -1e-3 -5e-4 0 0 0 1e-4 0 0 0 0 0 0 0 0 0 0 0 0");
  polargrain::testing::write(scratch.path() / "in.replay", script);
  const Outcome refused =
      run_in(scratch.path(), std::string(POLARGRAIN_LIGGGHTS) + " -in in.replay -log none");
  EXPECT_NE(refused.status, 0);
  EXPECT_NE(refused.out.find("discs cannot move out of their plane"), std::string::npos) << refused.out;
}

/// The path of a point: the program writes the folder, the engine's program goes it again.
TEST(Replay, IsWrittenByPolargrainPoint) {
  const Scratch scratch("replay_point");
  polargrain::testing::write(scratch.path() / "path.csv", "h11,h22\n5e-4,-1e-3\n2e-4,-5e-4\n");
  const std::string root = std::filesystem::current_path().string();
  const Outcome point =
      run_in(scratch.path(), std::string(POLARGRAIN) + " point " + root +
                                 "/cases/biaxial/case.yaml sand path.csv --replay way -o answers.csv");
  ASSERT_EQ(point.status, 0) << point.errors;
  const Outcome outcome =
      run_in(scratch.path() / "way", std::string(POLARGRAIN_LIGGGHTS) + " -in in.replay -log none");
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  const auto printed = replay_reports(outcome.out);
  ASSERT_EQ(printed.size(), 2u);
  EXPECT_EQ(printed, replay_reports(polargrain::testing::content(scratch.path() / "way" / "README.md")));
  // The normal stresses of the last row are those of the answers, written with the same digits.
  const std::string answers = polargrain::testing::content(scratch.path() / "answers.csv");
  std::istringstream words(printed.back());
  std::string word;
  std::string stress_11;
  words >> word >> word >> word >> word >> stress_11;
  EXPECT_NE(answers.find("\n2," + stress_11 + ","), std::string::npos) << stress_11 << "\n" << answers;
}

/// Rows of a point that is strained while it turns by 9 degrees a row, about the start of each row.
std::string turning_rows(int rows, double turn) {
  const auto place = [turn](int row) {
    Eigen::Matrix2d stretch;
    stretch << 3e-4, 2e-4, 2e-4, -8e-4;
    return Eigen::Matrix2d(Eigen::Rotation2Dd(row * turn) * (Eigen::Matrix2d::Identity() + row * stretch));
  };
  std::string text = "h11,h12,h21,h22,w\n";
  for (int row = 0; row < rows; ++row) {
    const Eigen::Matrix2d h = place(row + 1) * place(row).inverse() - Eigen::Matrix2d::Identity();
    text +=
        fmt::format("{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", h(0, 0), h(0, 1), h(1, 0), h(1, 1), turn);
  }
  return text;
}

/// Stress of the last row of a table of answers.
Eigen::Matrix2d last_stress(const std::filesystem::path& table) {
  std::string last;
  std::istringstream lines(polargrain::testing::content(table));
  for (std::string line; std::getline(lines, line);) last = line;
  std::vector<double> n;
  std::istringstream words(last);
  for (std::string word; n.size() < 6 && std::getline(words, word, ',');) n.push_back(std::stod(word));
  Eigen::Matrix2d s;
  s << n.at(1), n.at(4), n.at(5), n.at(2);
  return s;
}

constexpr double kNineDegrees = M_PI / 20.0;

// The table, the README of the replay and the replay are one path, and the stress turns with the material.
TEST(Replay, OfAPointInLargeDeformationIsThePathOfItsTable) {
  const Scratch scratch("replay_large");
  polargrain::testing::write(scratch.path() / "turned.csv", turning_rows(5, kNineDegrees));
  polargrain::testing::write(scratch.path() / "straight.csv", turning_rows(5, 0.0));
  const std::string root = std::filesystem::current_path().string();
  for (const char* path : {"turned", "straight"}) {
    const Outcome point = run_in(
        scratch.path(), std::string(POLARGRAIN) + " point " + root + "/cases/biaxial/case.yaml sand " + path +
                            ".csv --set deformation=large --replay " + path + " -o " + path + "_answers.csv");
    ASSERT_EQ(point.status, 0) << point.errors;
  }
  const Outcome outcome =
      run_in(scratch.path() / "turned", std::string(POLARGRAIN_LIGGGHTS) + " -in in.replay -log none");
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  const auto printed = replay_reports(outcome.out);
  ASSERT_EQ(printed.size(), 5u);
  EXPECT_EQ(printed, replay_reports(polargrain::testing::content(scratch.path() / "turned" / "README.md")));
  const Eigen::Matrix2d turned = last_stress(scratch.path() / "turned_answers.csv");
  const Eigen::Matrix2d straight = last_stress(scratch.path() / "straight_answers.csv");
  const std::vector<double> last = numbers(printed.back());  // increment, s11, s22, s33, s12, s21
  EXPECT_EQ(last.at(1), turned(0, 0));
  EXPECT_EQ(last.at(2), turned(1, 1));
  EXPECT_NEAR(0.5 * (last.at(4) + last.at(5)), turned(0, 1), 1e-9);
  const Eigen::Matrix2d r = Eigen::Rotation2Dd(5 * kNineDegrees).toRotationMatrix();
  const double error = (turned - r * straight * r.transpose()).norm() / straight.norm();
  std::cout << "[figure] point turned by 45 degrees in 5 rows: stress off by " << error << '\n';
  EXPECT_LT(error, 1e-6);
  EXPECT_GT((turned - straight).norm(), 0.1 * straight.norm()) << "the test would see nothing";
}

TEST(Replay, APointOfALawTurnsItsStressInLargeDeformation) {
  const Scratch scratch("point_large");
  polargrain::testing::write(
      scratch.path() / "case.yaml",
      "title: a law\ndeformation: large\n"
      "mesh: {rectangle: {size: [1, 1], elements: [1, 1]}}\n"
      "materials: {soil: {model: elastic, E: 50 MPa, nu: 0.3, Gc: 10 MPa, lc: 10 mm}}\n"
      "regions: {all: soil}\nboundary: [{on: bottom, fix: [u1, u2]}]\n"
      "steps: {count: 1}\n");
  polargrain::testing::write(scratch.path() / "turned.csv", turning_rows(5, kNineDegrees));
  polargrain::testing::write(scratch.path() / "straight.csv", turning_rows(5, 0.0));
  for (const char* path : {"turned", "straight"}) {
    const Outcome point = run_in(scratch.path(), std::string(POLARGRAIN) + " point case.yaml soil " + path +
                                                     ".csv -o " + path + "_answers.csv");
    ASSERT_EQ(point.status, 0) << point.errors;
  }
  const Eigen::Matrix2d straight = last_stress(scratch.path() / "straight_answers.csv");
  const Eigen::Matrix2d r = Eigen::Rotation2Dd(5 * kNineDegrees).toRotationMatrix();
  const Eigen::Matrix2d expected = r * straight * r.transpose();
  EXPECT_LT((last_stress(scratch.path() / "turned_answers.csv") - expected).norm(), 1e-12 * straight.norm());
  // Hooke's law over 4e-3 of vertical strain: 5 rows of -8e-4, of 3e-4 across.
  EXPECT_NEAR(straight(1, 1), 50e6 / (1.3 * 0.4) * (0.7 * -4e-3 + 0.3 * 1.5e-3), 1e3);
}

struct BadFix {
  std::string words;
  std::string expected;
};

TEST(Replay, ErrorsOfTheFixNameScriptAndLine) {
  const Scratch scratch("replay_errors");
  coupler::write_replay(scratch.path(), test::demo_cell(), CellRequest{nullptr, in_space(kPath[0])},
                        "A test.");
  const std::string head = "variable packing index packing.data\ninclude cell.in\n";
  for (const BadFix& bad : {BadFix{"damping 1.5", "damping must be at least 0 and less than 1"},
                            BadFix{"dampling 0.1", "unknown or incomplete keyword 'dampling'"},
                            BadFix{"unbalanced 1e-3", "a value is missing at the end"},
                            BadFix{"version 7", "this script is of version 7"},
                            BadFix{"packing_state nowhere", "there is no file nowhere"}}) {
    polargrain::testing::write(scratch.path() / "bad.in",
                               head + "fix cell all cell/load " + bad.words + "\n");
    const Outcome outcome =
        run_in(scratch.path(), std::string(POLARGRAIN_LIGGGHTS) + " -in bad.in -log none");
    EXPECT_NE(outcome.status, 0);
    EXPECT_NE(outcome.out.find(bad.expected), std::string::npos) << bad.words << "\n" << outcome.out;
    EXPECT_NE(outcome.errors.find("bad.in:3: fix cell all cell/load " + bad.words), std::string::npos)
        << outcome.errors;
  }
}

}  // namespace
}  // namespace polargrain::dem
