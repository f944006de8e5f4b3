// SPDX-License-Identifier: GPL-2.0-or-later
// The grains of points after runs with real grains: what VTK reads in the files adds up to what the run says of the point.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include "fem/output/read_vtu.hpp"
#include "tests/faults/checkpoint_runs.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::filesystem::path kSource = POLARGRAIN_SOURCE_DIRECTORY;
const std::string kProgram = POLARGRAIN;

using Values = std::map<std::string, std::vector<double>>;

/// Two elements between rough plates, compressed and sheared, so that boxes turn.
std::string case_text(const std::string& material, const std::string& more = {}) {
  return "title: Two elements of grains\n"
         "mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [1, 2]}}\n"
         "deformation: large\n"
         "materials: {sand: {" +
         material +
         "}}\n"
         "regions: {all: sand}\n"
         "boundary:\n"
         "  - {on: bottom, fix: [u1, u2]}\n"
         "  - {on: top, move: {u1: 4 mm, u2: -4 mm}}\n"
         "  - {on: [left, right], pressure: 100 kPa}\n"
         "steps: {count: 4, tolerance: 1e-2}\n" +
         more;
}

const std::string kDiscs = ", script: cells/hooke_radii.in, packing: packing100.h5";
const std::string kRollingDiscs =
    ", script: cells/hooke_li_chu.in, packing: packing100.h5, rotations: controlled";

class GrainsCommand : public ::testing::Test {
 protected:
  GrainsCommand() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::copy(kSource / "cases/footing_cells/packing100.h5", folder());
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return scratch_.path(); }

  void run_case(const std::string& text, const std::string& options = {}) const {
    write(folder() / "case.yaml", text);
    const Outcome run = run_in(folder(), kProgram + " run case.yaml -o out -w 2 --quiet " + options);
    ASSERT_EQ(run.status, 0) << run.errors;
  }

  /// The sums over the grains of a point, and the fields of the point.
  /// @param entry of the collection @param step nothing: the same
  [[nodiscard]] Values seen(std::size_t point, int entry, std::optional<int> step = {}) const {
    const std::string grains = "out/grains/point-" + std::to_string(point) + ".pvd";
    std::string points = std::to_string(step.value_or(entry));
    points = "out/fields/points-" + std::string(5 - points.size(), '0') + points + ".vtu";
    const Outcome read =
        run_in(folder(), "/usr/bin/python3 " GRAINS_READER " " + grains + " " + std::to_string(entry) + " " +
                             points + " " + std::to_string(point));
    EXPECT_EQ(read.status, 0) << read.errors;
    Values values;
    std::istringstream lines(read.out);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string name;
      words >> name;
      for (double value = 0.0; words >> value;) values[name].push_back(value);
    }
    return values;
  }

  /// Grains and point agree, whatever the model of the material, about the diagnostics of the cell.
  static void expect_diagnostics(Values& values) {
    for (const char* name : {"void_ratio", "coordination_number", "sliding_fraction", "rolling_fraction",
                             "rattlers", "mean_rotation", "rotation_spread"}) {
      const std::vector<double>& told = values[std::string("point:") + name];
      if (told.empty()) continue;
      ASSERT_EQ(values[name].size(), 1u) << name;
      EXPECT_NEAR(values[name][0], told[0], 1e-12) << name;
    }
    ASSERT_FALSE(values["point:void_ratio"].empty());
    EXPECT_LT(values["volume_error"][0], 1e-14);
    EXPECT_LT(values["normal_force_error"][0], 1e-12);
    EXPECT_LT(values["tangential_force_error"][0], 1e-12);
    EXPECT_LT(values["glyph_error"][0], 1e-5);  // in single precision
    EXPECT_EQ(values["other_glyphs"][0], 0.0);
  }

  /// In-plane stress (11 22 12 21) from branches and forces of the file, and that of the point; Pa.
  static std::array<double, 4> of_grains(Values& values) {
    const std::vector<double>& s = values["stress"];
    return {s.at(0), s.at(4), s.at(1), s.at(3)};
  }
  static std::array<double, 4> of_point(Values& values) {
    const std::vector<double>& s = values["point:stress"];
    return {s.at(0), s.at(1), s.at(3), s.at(4)};
  }

  void show(const std::string& options) const {
    const Outcome shown = run_in(folder(), kProgram + " grains out " + options);
    ASSERT_EQ(shown.status, 0) << shown.errors;
  }

  /// Free rotations: the skew part of the stress is not of the grains.
  void expect_symmetric_stress(std::size_t point, int step, bool in_space = false) const {
    Values values = seen(point, step);
    expect_diagnostics(values);
    const auto grains = of_grains(values);
    const auto told = of_point(values);
    EXPECT_NEAR(grains[0], told[0], 1e-6);  // of 1e5 Pa: round-off of the sum
    EXPECT_NEAR(grains[1], told[1], 1e-6);
    EXPECT_NEAR(0.5 * (grains[2] + grains[3]), 0.5 * (told[2] + told[3]), 1e-6);
    if (in_space) {
      EXPECT_NEAR(values["stress"].at(8), values["point:stress"].at(2), 1e-6);
    }
    if (step > 0) {
      EXPECT_GT(values["moved"].at(0), 1e-3);
    }
    EXPECT_EQ(values["edges"].at(0), in_space ? 12.0 : 4.0);
  }

  Scratch scratch_;
};

TEST_F(GrainsCommand, StressFromBranchesAndForcesIsThatOfThePoint) {
  run_case(case_text("model: cell, lc: 8 mm" + kDiscs));
  show("--point 0 --point 5");
  for (const int step : {0, 1, 4}) expect_symmetric_stress(5, step);
  expect_symmetric_stress(0, 4);
  Values values = seen(5, 4);
  EXPECT_EQ(values["time"].at(0), 1.0);
  EXPECT_GT(values["sliding_fraction"].at(0), 0.01);
  // A single step, elsewhere: the same bytes.
  show("--point 5 --last -o elsewhere");
  EXPECT_TRUE(content(folder() / "elsewhere/point-5/step-00004.vtu") ==
              content(folder() / "out/grains/point-5/step-00004.vtu"));
  EXPECT_FALSE(std::filesystem::exists(folder() / "elsewhere/point-5/step-00003.vtu"));
}

TEST_F(GrainsCommand, AReportShowsThoseOfTheElementThatHasShearedMost) {
  run_case(case_text("model: cell, lc: 8 mm" + kDiscs));
  const Outcome outcome = run_in(folder(), kProgram + " report out");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const std::string page = content(folder() / "out/report.html");
  // Its number is that of the first point of an element; what stands there is what the point tells.
  const std::string words = "out: the grains of point ";
  const std::size_t place = page.find(words);
  ASSERT_NE(place, std::string::npos);
  const std::size_t point = std::stoul(page.substr(place + words.size()));
  EXPECT_TRUE(point == 0 || point == 4) << point;
  const fem::FieldFile<2> last = fem::read_vtu(folder() / "out/fields/step-00004.vtu");
  const std::vector<double>& sheared = fem::find_field(last.fields.cells, "deviatoric_strain")->values;
  EXPECT_EQ(point == 0, sheared[0] > sheared[1]);
  show("--point " + std::to_string(point));
  for (const int step : {0, 4}) {
    Values values = seen(point, step);
    const double contacts = values["point:contacts"].at(0);
    const std::string caption = "step " + std::to_string(step) + ": 100 grains, " +
                                std::to_string(std::lround(contacts)) + " contacts, " +
                                std::to_string(std::lround(100.0 * values["sliding_fraction"].at(0))) +
                                " % of them sliding";
    EXPECT_NE(page.find(caption), std::string::npos) << caption;
  }
  EXPECT_EQ(run_in(folder(), kProgram + " report out --no-grains").status, 0);
  EXPECT_EQ(content(folder() / "out/report.html").find("<svg"), std::string::npos);
}

TEST_F(GrainsCommand, TheEnginesOwnLoopShowsItsGrainsToo) {
  run_case(case_text("model: cell, loop: engine, lc: 8 mm" + kDiscs));
  show("--point 5");
  for (const int step : {0, 4}) expect_symmetric_stress(5, step);
}

TEST_F(GrainsCommand, WithControlledRotationsTheSkewStressIsOfTheGrains) {
  run_case(case_text("model: cell" + kRollingDiscs));
  show("--point 3");
  for (const int step : {0, 4}) {
    Values values = seen(3, step);
    expect_diagnostics(values);
    const auto grains = of_grains(values);
    const auto told = of_point(values);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(grains[i], told[i], 1e-6) << i;
    if (step == 0) continue;
    EXPECT_GT(std::abs(told[2] - told[3]), 10.0);
    EXPECT_GT(values["rolling_moment"].at(0), 0.0);
    EXPECT_NEAR(grains[3] - grains[2], values["point:multiplier"].at(0), 0.05 * 1e5);
  }
}

TEST_F(GrainsCommand, PointsThatShareACellShowTheGrainsThatTheyGoBy) {
  run_case(case_text("model: adaptive, adaptive: {tolerance: 0.2 %}, lc: 8 mm" + kDiscs));
  show("--point 0 --point 6");
  for (const std::size_t point : {0u, 6u})
    for (const int step : {2, 4}) {
      Values values = seen(point, step);
      expect_diagnostics(values);
      const auto grains = of_grains(values);
      const auto told = of_point(values);
      // Carried along the tangent from where the cell was run, within the tolerance and its margin.
      for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(grains[i], told[i], 0.1 * 1e5) << i;
    }
}

TEST_F(GrainsCommand, OfALawThatCellsInformTheCellsAreShown) {
  run_case(case_text("model: informed, lc: 8 mm" + kDiscs));
  show("--point 2");
  for (const int step : {0, 4}) {
    Values values = seen(2, step);
    expect_diagnostics(values);
    const auto cell = of_grains(values);
    const auto law = of_point(values);
    const auto shear = [](const std::array<double, 4>& s) { return 0.5 * (s[2] + s[3]); };
    const double difference = std::sqrt(std::pow(cell[0] - law[0], 2) + std::pow(cell[1] - law[1], 2) +
                                        2.0 * std::pow(shear(cell) - shear(law), 2));
    const double size = std::sqrt(law[0] * law[0] + law[1] * law[1] + 2.0 * std::pow(shear(law), 2));
    EXPECT_NEAR(difference / size, values["point:stress_mismatch"].at(0), 1e-9);
  }
}

// The grains begin where those of another run ended, and under other contacts: both are told, before and behind the run.
TEST_F(GrainsCommand, ARunThatBeginsInAnotherShowsNone) {
  const std::string script = content(kSource / "liggghts_inputs/cells/hooke_radii.in");
  write(folder() / "cell.in", script);
  write(folder() / "soft.in", script + "\n# softer\n");
  const std::string steps = "count: 4, tolerance: 1e-2";
  std::string text = case_text("model: cell, lc: 8 mm, script: cell.in, packing: packing100.h5");
  text.replace(text.find("deformation: large\n"), 19, "");
  run_case(text.replace(text.find(steps), steps.size(), "count: 1, tolerance: 1e-2"));
  std::filesystem::rename(folder() / "out", folder() / "first");
  text += "start_from: first\n";
  write(folder() / "case.yaml", text + "output: {grains: [0]}\n");
  const Outcome same = run_in(folder(), kProgram + " check case.yaml --all");
  EXPECT_NE(same.out.find("output: no grains are shown in a run with 'start_from'"), std::string::npos)
      << same.out;
  EXPECT_EQ(same.out.find("the contact script"), std::string::npos) << same.out;
  write(folder() / "case.yaml", text);
  const Outcome soft =
      run_in(folder(), kProgram + " check case.yaml --all --set materials.sand.script=soft.in");
  EXPECT_NE(soft.out.find("the contact script of region 'all' is another one than in 'first'"),
            std::string::npos)
      << soft.out;
  EXPECT_EQ(soft.out.find("no grains are shown"), std::string::npos) << soft.out;
  run_case(text, "--set steps.count=4");
  const Outcome shown = run_in(folder(), kProgram + " grains out --point 0 --last");
  EXPECT_EQ(shown.status, 1);
  EXPECT_NE(shown.errors.find("the run begins with the grains at the end of another one ('start_from')"),
            std::string::npos)
      << shown.errors;
}

TEST_F(GrainsCommand, SpheresInSpaceInAllThreeSchemes) {
  write(folder() / "spheres.yaml",
        "grains: 100\nsizes: {law: uniform, radius: [4 mm, 6 mm]}\ndensity: 2650\ndimension: 3\n"
        "script: cells/spheres_hooke_radii.in\npressure: 100 kPa\nfriction: 0.2\nseed: 5\n");
  const Outcome packed = run_in(folder(), kProgram + " pack spheres.yaml -o spheres.h5 --quiet");
  ASSERT_EQ(packed.status, 0) << packed.errors;
  const std::string spheres = ", lc: 20 mm, script: cells/spheres_hooke_radii.in, packing: spheres.h5";
  // One element, and a quarter of the way.
  const std::string smaller =
      "--set mesh.rectangle.elements='[1, 1]' --set steps.count=2 --set boundary.1.move.u1='1 mm' --set boundary.1.move.u2='-1 mm'";
  run_case(case_text("model: cell" + spheres), smaller);
  show("--point 3");
  for (const int step : {0, 2}) expect_symmetric_stress(3, step, true);
  const std::string held =
      ", rotations: controlled, script: cells/spheres_hooke_radii.in, packing: spheres.h5";
  run_case(case_text("model: cell" + held), smaller);
  show("--point 2 --step 2");
  Values whole = seen(2, 0, 2);
  expect_diagnostics(whole);
  const auto grains = of_grains(whole);
  const auto told = of_point(whole);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(grains[i], told[i], 1e-6) << i;
  EXPECT_GT(std::abs(told[2] - told[3]), 10.0);
  for (const char* model : {"adaptive", "informed"}) {
    run_case(case_text(std::string("model: ") + model + spheres), smaller);
    show("--point 1");
    Values values = seen(1, 2);
    expect_diagnostics(values);
  }
}

TEST_F(GrainsCommand, ARunThatWasKilledKeepsTheSameBytes) {
  run_case(case_text("model: adaptive, adaptive: {tolerance: 1 %}, lc: 8 mm" + kDiscs));
  std::filesystem::rename(folder() / "out", folder() / "whole");
  {
    RunningProgram program(folder(), "run case.yaml -o out -w 1 --quiet --checkpoint-minutes 0");
    await(program, [&] { return std::filesystem::exists(folder() / "out/checkpoint.h5"); });
    program.end(SIGKILL);
  }
  const Outcome resumed = run_in(folder(), kProgram + " run case.yaml -o out -w 2 --quiet --resume");
  ASSERT_EQ(resumed.status, 0) << resumed.errors;
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder() / "whole/cell_paths")) {
    ++files;
    EXPECT_TRUE(content(entry.path()) == content(folder() / "out/cell_paths" / entry.path().filename()))
        << entry.path();
  }
  EXPECT_EQ(files, 6);  // the cells, and the steps 0 to 4
  show("--point 0 --last");
}

TEST_F(GrainsCommand, ARunShowsThePointsThatItsCaseNames) {
  const std::string material = "model: adaptive, adaptive: {tolerance: 1 %}, lc: 8 mm" + kDiscs;
  run_case(case_text(material, "output: {every: 2, grains: [all]}\n"));
  for (const char* file : {"logs/grains.log", "grains/engine.log"})
    EXPECT_EQ(content(folder() / "out" / file), "") << file;
  // The last step begins from the states of step 2 that were kept, and every one of a run that kept none from the packing:
  // the same bytes.
  std::filesystem::rename(folder() / "out", folder() / "named");
  run_case(case_text(material));
  show("--point 0 --point 7");
  for (const char* point : {"point-0", "point-7"})
    for (const char* step : {"step-00000.vtu", "step-00002.vtu", "step-00004.vtu"})
      EXPECT_TRUE(content(folder() / "named/grains" / point / step) ==
                  content(folder() / "out/grains" / point / step))
          << point << ' ' << step;
  EXPECT_FALSE(std::filesystem::exists(folder() / "named/grains/point-0/step-00003.vtu"));
  EXPECT_TRUE(std::filesystem::exists(folder() / "named/grains/point-3.pvd"));
  EXPECT_NE(
      content(folder() / "named/grains/point-7.pvd").find("timestep=\"0.5\" file=\"point-7/step-00002.vtu\""),
      std::string::npos);
  // It is of no consequence to the run.
  EXPECT_TRUE(content(folder() / "named/history.csv") == content(folder() / "out/history.csv"));

  write(folder() / "case.yaml", case_text(material, "output: {grains: [sand, 8]}\n"));
  const Outcome checked = run_in(folder(), kProgram + " check case.yaml");
  EXPECT_EQ(checked.status, 2);
  for (const char* message :
       {"case.yaml:11: output: grains: 'sand' is no region of the mesh (all) and no integration point",
        "'8' is no region of the mesh (all) and no integration point of it (0 to 7)"})
    EXPECT_NE(checked.errors.find(message), std::string::npos) << checked.errors;
  write(folder() / "case.yaml",
        case_text("model: elastic, E: 20 MPa, nu: 0.3, Gc: 4 MPa, lc: 8 mm", "output: {grains: [3]}\n"));
  const Outcome elastic = run_in(folder(), kProgram + " check case.yaml");
  EXPECT_NE(elastic.errors.find("grains: the material of point 3 has no cells"), std::string::npos)
      << elastic.errors;
}

TEST_F(GrainsCommand, WhatIsNotThereIsSaid) {
  run_case(case_text("model: cell, lc: 8 mm" + kDiscs));
  const auto refused = [&](const std::string& options, const std::string& what) {
    const Outcome outcome = run_in(folder(), kProgram + " grains " + options);
    EXPECT_EQ(outcome.status, 2) << options;
    EXPECT_NE(outcome.errors.find(what), std::string::npos) << outcome.errors;
    EXPECT_FALSE(std::filesystem::exists(folder() / "out/grains"));
  };
  refused("out --point 8", "--point 8: the points of this run are 0 to 7, in the order of points-NNNNN.vtu");
  refused("out --point 0 --step 5", "--step 5: the run has the steps 0 to 4");
  refused("out --point 0 --step 1 --last", "--step excludes --last");
  refused("out --step 1", "--point is missing");
  refused(". --point 0", "has no records of its cells");
  std::filesystem::remove(folder() / "out/cell_paths/step-00002.h5");
  const Outcome outcome = run_in(folder(), kProgram + " grains out --point 0 --last");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.errors.find("how its grains came to be was not kept from the start"), std::string::npos)
      << outcome.errors;
}

}  // namespace
}  // namespace polargrain::testing
