// SPDX-License-Identifier: GPL-2.0-or-later
// A rough wall, 35 mm high, pushed 2 mm into ground of grains: the scene of docs/questions.md. It does not get through as it
// is, is told what to change, and gets through with that. And grains that part, which are named.
#include <gtest/gtest.h>

#include <algorithm>

#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::string kProgram = POLARGRAIN;
const std::string kSource = POLARGRAIN_SOURCE_DIRECTORY;

double sum(const std::vector<double>& values) {
  double all = 0.0;
  for (const double value : values) all += value;
  return all;
}

TEST(Struggling, AWallIsToldWhatItNeedsAndGetsThroughWithIt) {
  const Scratch scratch("struggling");
  const std::filesystem::path& at = scratch.path();
  write(at / "case.yaml", content(kSource + "/tests/data/fem/wall.yaml"));
  write(at / "cell.in", content(kSource + "/liggghts_inputs/cells/hooke_radii.in"));
  std::filesystem::copy_file(kSource + "/cases/footing_cells/packing100.h5", at / "grains.h5");
  std::filesystem::copy_file(kSource + "/tests/data/fem/wall.msh", at / "wall.msh");

  const Outcome first = run_in(at, kProgram + " run case.yaml -o first -w 2");
  EXPECT_EQ(first.status, 1);
  EXPECT_NE(first.errors.find("this step has been cut twice"), std::string::npos) << first.errors;
  const std::string said = first.errors.substr(first.errors.find("did not converge"));
  EXPECT_NE(said.find("of the unbalanced force is at the nodes ("), std::string::npos) << said;
  EXPECT_NE(said.find("values there, before this step:\n    element "), std::string::npos) << said;
  const std::string key = "worth trying below 'steps': jumps: ";
  const std::size_t place = said.find(key);
  ASSERT_NE(place, std::string::npos) << said;
  const std::string jumps =
      said.substr(place + key.size(), said.find(' ', place + key.size()) - place - key.size());

  const Outcome second = run_in(at, kProgram + " run case.yaml -o second -w 2 --set steps.jumps=" + jumps);
  EXPECT_EQ(second.status, 0) << second.errors;
  const CsvTable before(at / "first/history.csv");
  const CsvTable after(at / "second/history.csv");
  std::cout << "[figure] iterations " << sum(before.numbers("iterations")) << " and "
            << sum(before.numbers("cuts")) << " cuts up to step " << before.numbers("step").back()
            << "; with " << jumps << " jumps " << sum(after.numbers("iterations")) << " and "
            << sum(after.numbers("cuts")) << " cuts to the end\n";
  EXPECT_EQ(after.numbers("step").back(), 8.0);
  EXPECT_LE(sum(after.numbers("cuts")), 5.0);
}

// Drawn up by 2 % while the pressure on its sides is taken away: at the end no grain touches another.
TEST(Struggling, PointsWhoseGrainsHavePartedAreNamed) {
  const Scratch scratch("parted");
  const std::filesystem::path& at = scratch.path();
  write(at / "case.yaml", R"(title: Grains drawn apart
mesh: {rectangle: {size: [1 m, 1 m], elements: [1, 1]}, element: Q8R}
materials:
  sand: {model: cell, script: cell.in, packing: grains.h5, lc: 10 mm}
regions: {all: sand}
boundary:
  - {on: bottom, fix: [u1, u2]}
  - {on: [left, right], pressure: [[0, 100 kPa], [1, 0]]}
  - {on: top, move: {u2: 20 mm}}
steps: {count: 8, cut: 3, iterations: 8}
)");
  write(at / "cell.in", content(kSource + "/liggghts_inputs/cells/hooke_radii.in"));
  std::filesystem::copy_file(kSource + "/cases/footing_cells/packing100.h5", at / "grains.h5");

  const Outcome outcome = run_in(at, kProgram + " run case.yaml -o out -w 1");
  EXPECT_EQ(outcome.status, 1);
  const std::size_t place = outcome.errors.find("of 4 points carry hardly any stress, least point ");
  ASSERT_NE(place, std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.errors.find("coordination_number 0, rattlers 1", place), std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("some pressure left on the free surface", place), std::string::npos)
      << outcome.errors;
}

// A vertical cut of 3 m with a cohesion of 7 kPa stands up to gamma h / c = 3.83 tan(45 deg + phi / 2) = 5.5; here it is 7.7.
// All loads and reactions are some twenty times the forces that the cut changes.
TEST(Struggling, ACutThatCollapsesIsNotBalancedByALooseTolerance) {
  const Scratch scratch("cut");
  write(scratch.path() / "case.yaml", R"(title: A vertical cut
continuum: cauchy
mesh: {rectangle: {size: [24 m, 9 m], elements: [24, 9], regions: {pit: [0, 6 m, 6 m, 9 m]}}}
materials:
  soil: {model: elastoplastic, E: 40 MPa, nu: 0.3, friction_angle: 20 deg, dilatancy_angle: 0 deg, cohesion: 7 kPa}
regions: {pit: soil, rest: soil}
boundary: [{on: [left, right], fix: [u1]}, {on: bottom, fix: [u1, u2]}]
body: [{unit_weight: 18 kN/m3}]
initial_stress: [{surface: 9 m, unit_weight: 18 kN/m3, K0: 0.6}]
steps: {stages: [{name: cut, remove: pit, count: 5}]}
)");
  EXPECT_EQ(run_in(scratch.path(), kProgram + " run case.yaml -o out").status, 1);
  const Outcome loose =
      run_in(scratch.path(), kProgram + " run case.yaml -o loose --set steps.tolerance=1e-2");
  EXPECT_NE(loose.errors.find("of the forces that change in stage 'cut' unbalanced, and a collapse unseen"),
            std::string::npos)
      << loose.errors;
}

}  // namespace
}  // namespace polargrain::testing
