// SPDX-License-Identifier: GPL-2.0-or-later
// polargrain new: what it writes is sound and runs as it is, in a folder of its own; what it refuses it says.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "common/csv_table.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::string kProgram = POLARGRAIN;
const std::string kSource = POLARGRAIN_SOURCE_DIRECTORY;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::set<std::string> files_of(const std::filesystem::path& directory) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    names.insert(entry.path().filename().string());
  return names;
}

/// Nothing but the folder is there, as on another machine.
Outcome check_moved(const Scratch& scratch, const std::string& name) {
  std::filesystem::rename(scratch.path() / name, scratch.path() / "moved");
  const Outcome outcome =
      run_in(scratch.path(), "POLARGRAIN_DATA=/nowhere " + kProgram + " check moved/case.yaml");
  std::filesystem::rename(scratch.path() / "moved", scratch.path() / name);
  return outcome;
}

TEST(NewCommand, ABiaxialCaseRunsAsItIs) {
  const Scratch scratch("new_biaxial");
  const Outcome written =
      run_in(scratch.path(), kProgram + " new biaxial -o mine --grains 100 --elements 1 2 --size 20cm 400mm");
  ASSERT_EQ(written.status, 0) << written.errors;
  EXPECT_TRUE(has(written.out, "100 grains in ")) << written.out;
  EXPECT_TRUE(has(written.out, "polargrain run mine/case.yaml")) << written.out;
  EXPECT_EQ(files_of(scratch.path() / "mine"),
            (std::set<std::string>{"case.yaml", "cell.in", "packing.h5", "packing.yaml"}));
  const Outcome checked = check_moved(scratch, "mine");
  ASSERT_EQ(checked.status, 0) << checked.errors;
  EXPECT_TRUE(has(checked.out, "no faults; 2 elements, 13 nodes, 23 steps, needs workers")) << checked.out;

  const Outcome run =
      run_in(scratch.path(), kProgram +
                                 " run mine/case.yaml -o out -w 1 --quiet --set steps.count=2 "
                                 "--set boundary.1.move.u2='-0.8 mm'");
  ASSERT_EQ(run.status, 0) << run.errors;
  const CsvTable history(scratch.path() / "out/history.csv");
  ASSERT_EQ(history.rows(), 3u);
  // 0.8 mm of 400 mm; the packing is under the pressure of the sides to its own tolerance, 1e-3 in each axis.
  EXPECT_NEAR(history.numbers("axial_strain")[2], 0.002, 1e-12);
  EXPECT_NEAR(history.numbers("stress_ratio")[0], 1.0, 2e-3);
  EXPECT_GT(history.numbers("stress_ratio")[2], 1.05);
}

TEST(NewCommand, WhatIsAskedForIsWhatIsWritten) {
  const Scratch scratch("new_options");
  const Outcome written =
      run_in(scratch.path(),
             kProgram + " new biaxial -o a/mine --pressure 0.2MPa --rolling --scheme informed --no-pack");
  ASSERT_EQ(written.status, 0) << written.errors;
  EXPECT_TRUE(has(written.out, "polargrain pack a/mine/packing.yaml -o a/mine/packing.h5")) << written.out;
  const std::filesystem::path mine = scratch.path() / "a/mine";
  EXPECT_FALSE(std::filesystem::exists(mine / "packing.h5"));
  EXPECT_EQ(content(mine / "cell.in"), content(kSource + "/liggghts_inputs/cells/hooke_rolling.in"));
  const std::string text = content(mine / "case.yaml");
  EXPECT_TRUE(has(text, "model: informed ")) << text;
  EXPECT_TRUE(has(text, "[left, right], pressure: 200 kPa}")) << text;
  EXPECT_FALSE(has(text, "@")) << text;
  EXPECT_TRUE(has(content(mine / "packing.yaml"), "grains: 400 ")) << content(mine / "packing.yaml");
  EXPECT_TRUE(has(content(mine / "packing.yaml"), "pressure: 200 kPa\n"));
}

// Of each kind that takes a size: strains and stresses would be off by the ratio of the sizes.
TEST(NewCommand, FormulasDivideByTheSizeAskedFor) {
  const Scratch scratch("new_sizes");
  for (const auto& [kind, size, section] :
       {std::array<std::string, 3>{"biaxial", "size: [0.25 m, 1.3 m]", "0.25 m"},
        std::array<std::string, 3>{"triaxial3d", "size: [0.25 m, 0.25 m, 1.3 m]", "0.25 m * 0.25 m"}}) {
    const Outcome written = run_in(scratch.path(), kProgram + " new " + kind + " -o " + kind +
                                                       " --size 25cm 1300mm --pressure 70kPa --no-pack");
    ASSERT_EQ(written.status, 0) << written.errors;
    const std::string text = content(scratch.path() / kind / "case.yaml");
    EXPECT_TRUE(has(text, size)) << text;
    EXPECT_TRUE(has(text, "axial_strain: -shortening / 1.3 m\n")) << text;
    EXPECT_TRUE(has(text, "stress_ratio: -top_force / (" + section + " * 70 kPa)\n")) << text;
  }
}

TEST(NewCommand, FootingAndElementAreSound) {
  const Scratch scratch("new_footing");
  const Outcome footing = run_in(scratch.path(), kProgram + " new footing -o ground");
  ASSERT_EQ(footing.status, 0) << footing.errors;
  const Outcome checked = check_moved(scratch, "ground");
  ASSERT_EQ(checked.status, 0) << checked.errors;
  EXPECT_TRUE(has(checked.out, "no faults; 140 elements")) << checked.out;
  EXPECT_TRUE(has(content(scratch.path() / "ground/case.yaml"), "{on: sides, fix: [u1, w]}"))
      << "the plane of symmetry must hold the rotation, or the halves do not fit";

  const Outcome element = run_in(scratch.path(), kProgram + " new element -o point --no-pack");
  ASSERT_EQ(element.status, 0) << element.errors;
  std::filesystem::copy_file(scratch.path() / "ground/packing.h5", scratch.path() / "point/packing.h5");
  const Outcome tested =
      run_in(scratch.path(), "POLARGRAIN_DATA=/nowhere " + kProgram +
                                 " element point/test.yaml -w 1 --quiet --set axial_strain=0.1% "
                                 "--set rows=2");
  ASSERT_EQ(tested.status, 0) << tested.errors;
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "element.csv"));
}

TEST(NewCommand, TriaxialIsATestOfSpheres) {
  const Scratch scratch("new_triaxial");
  const Outcome written = run_in(scratch.path(), kProgram + " new triaxial -o point --grains 40 --rolling");
  ASSERT_EQ(written.status, 0) << written.errors;
  const Outcome tested =
      run_in(scratch.path(), "POLARGRAIN_DATA=/nowhere " + kProgram +
                                 " element point/test.yaml -w 1 --quiet --set axial_strain=0.1% "
                                 "--set rows=2");
  ASSERT_EQ(tested.status, 0) << tested.errors;
  const std::string curve = content(scratch.path() / "element.csv");
  EXPECT_TRUE(has(curve, "e33,e12,e13,e23")) << curve;  // of space
}

TEST(NewCommand, BodiesInSpaceAreSound) {
  const Scratch scratch("new_in_space");
  const Outcome written =
      run_in(scratch.path(), kProgram + " new triaxial3d -o mine --grains 60 --elements 1 1");
  ASSERT_EQ(written.status, 0) << written.errors;
  const Outcome checked = check_moved(scratch, "mine");
  ASSERT_EQ(checked.status, 0) << checked.errors;
  EXPECT_TRUE(has(checked.out, "no faults; 1 elements in space, 20 nodes")) << checked.out;
  const Outcome run =
      run_in(scratch.path(), kProgram +
                                 " run mine/case.yaml -o out -w 1 --quiet --set steps.count=1 "
                                 "--set boundary.1.move.u3='-0.2 mm'");
  ASSERT_EQ(run.status, 0) << run.errors;
  const CsvTable history(scratch.path() / "out/history.csv");
  // The packing is under the pressure of the sides to its own tolerance, 1e-3 in each axis.
  EXPECT_NEAR(history.numbers("stress_ratio")[0], 1.0, 2e-3);
  EXPECT_NEAR(history.numbers("axial_strain")[1], 0.001, 1e-12);
  EXPECT_GT(history.numbers("stress_ratio")[1], 1.05);

  const Outcome footing = run_in(scratch.path(), kProgram + " new footing3d -o ground --no-pack");
  ASSERT_EQ(footing.status, 0) << footing.errors;
  std::filesystem::copy_file(scratch.path() / "mine/packing.h5", scratch.path() / "ground/packing.h5");
  const Outcome sound = check_moved(scratch, "ground");
  ASSERT_EQ(sound.status, 0) << sound.errors;
  EXPECT_TRUE(has(sound.out, "no faults; 48 elements in space")) << sound.out;
}

TEST(NewCommand, ASlopeIsThatOfTheLibrary) {
  const Scratch scratch("new_slope");
  const Outcome written = run_in(scratch.path(), kProgram + " new slope -o hill");
  ASSERT_EQ(written.status, 0) << written.errors;
  const Outcome checked = check_moved(scratch, "hill");
  EXPECT_EQ(checked.status, 0) << checked.errors;
  EXPECT_TRUE(has(checked.out, "needs no workers")) << checked.out;
  const Outcome grains = run_in(scratch.path(), kProgram + " new slope -o other --grains 100");
  EXPECT_EQ(grains.status, 2);
  EXPECT_TRUE(has(grains.errors, "--grains is not for this kind; a slope begins without stress"))
      << grains.errors;
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "other"));
}

// The wall carries the earth pressure that the anchor and the ground before it give back, and the way of digging is told.
TEST(NewCommand, AnExcavationRunsAsItIs) {
  const Scratch scratch("new_excavation");
  const Outcome written = run_in(scratch.path(), kProgram + " new excavation -o pit");
  ASSERT_EQ(written.status, 0) << written.errors;
  const Outcome checked = check_moved(scratch, "pit");
  EXPECT_EQ(checked.status, 0) << checked.errors;
  EXPECT_TRUE(has(checked.out, "needs no workers")) << checked.out;
  const Outcome strict = run_in(scratch.path(), kProgram + " check pit/case.yaml --strict");
  EXPECT_EQ(strict.status, 0) << strict.errors;
  const Outcome run = run_in(scratch.path(), kProgram + " run pit/case.yaml -o out --quiet");
  ASSERT_EQ(run.status, 0) << run.errors;
  const CsvTable history(scratch.path() / "out/history.csv");
  const auto last = history.rows() - 1;
  EXPECT_EQ(history.rows(), 15u);  // step 0 and those of six stages
  // K0 against the wall when it has come, over its 11 m: the stress of the ground; the toe has that of the node above it.
  EXPECT_NEAR(history.numbers("earth")[1], 0.43 * 18e3 * 11 * 11 / 2, 3e-3 * 0.43 * 18e3 * 11 * 11 / 2);
  EXPECT_NEAR(history.numbers("lever")[1], 11.0 / 3, 1e-2);
  // It falls towards the active one, which with friction at the wall is below Rankine's, as the wall gives way.
  EXPECT_LT(history.numbers("earth")[last], history.numbers("earth")[1]);
  EXPECT_GT(history.numbers("pull")[last], 20e3);
  EXPECT_GT(std::abs(history.numbers("moment")[last]), 20e3);
  EXPECT_LT(std::abs(history.numbers("moment")[last]), 500e3);  // the plastic moment
  EXPECT_GT(history.numbers("heave")[last], 0.0);
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "out/profiles/trough-00014.csv"));
}

// It is run, and its forces held against statics, by the test of the page docs/howto/water.md.
TEST(NewCommand, AQuayIsCheckedStrictly) {
  const Scratch scratch("new_quay");
  const Outcome written = run_in(scratch.path(), kProgram + " new quay -o quay");
  ASSERT_EQ(written.status, 0) << written.errors;
  const Outcome strict = run_in(scratch.path(), kProgram + " check quay/case.yaml --strict");
  EXPECT_EQ(strict.status, 0) << strict.out << strict.errors;
  EXPECT_TRUE(has(strict.out, "needs no workers")) << strict.out;
}

// Its one remark is true: boxes soften behind their peak, and elements of a metre have no length.
TEST(NewCommand, AQuayMayHaveBoxesBehindTheWall) {
  const Scratch scratch("new_quay_on_grains");
  const Outcome written = run_in(scratch.path(), kProgram + " new quay -o quay --grains 60 --rolling");
  ASSERT_EQ(written.status, 0) << written.errors;
  const Outcome checked = check_moved(scratch, "quay");
  EXPECT_EQ(checked.status, 0) << checked.out << checked.errors;
  EXPECT_TRUE(has(checked.out, "region 'near' (grains): elements of 1 m; 60 grains a cell")) << checked.out;
  EXPECT_TRUE(has(checked.out, "1 remark on the case")) << checked.out;
  const Outcome bare = run_in(scratch.path(), kProgram + " new quay -o bare --rolling");
  EXPECT_EQ(bare.status, 2);
  EXPECT_TRUE(has(bare.errors, "--pressure and --rolling go with --grains")) << bare.errors;
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "bare"));
}

TEST(NewCommand, AMeshOfOnesOwnIsHeldAtItsLowestBoundary) {
  const Scratch scratch("new_mesh");
  const Outcome written = run_in(scratch.path(), kProgram + " new mesh --mesh '" + kSource +
                                                     "/cases/slope/slope.msh' -o own --grains 50");
  ASSERT_EQ(written.status, 0) << written.errors;
  const Outcome checked = check_moved(scratch, "own");
  ASSERT_EQ(checked.status, 0) << checked.errors;
  const std::string text = content(scratch.path() / "own/case.yaml");
  EXPECT_TRUE(has(text, "boundaries (physical curves):  base, crest, face, sides\n")) << text;
  EXPECT_TRUE(has(text, "  - {on: base, fix: [u1, u2]}\n")) << text;
  EXPECT_TRUE(has(text, "  - {on: crest, pressure: [[0, 100 kPa], [1, 110 kPa]]}\n")) << text;
  EXPECT_TRUE(has(text, "model: adaptive ")) << text;
}

// A pressure on it would push one side at random.
TEST(NewCommand, AMeshWithACurveInsideIsLoadedOnItsOutlineAlone) {
  const Scratch scratch("new_mesh_inside");
  write(scratch.path() / "two.msh",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
        "$PhysicalNames\n4\n1 1 \"base\"\n1 2 \"seam\"\n1 3 \"top\"\n2 4 \"ground\"\n$EndPhysicalNames\n"
        "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 1 2 0\n6 0 2 0\n$EndNodes\n"
        "$Elements\n5\n1 1 2 1 1 1 2\n2 1 2 2 2 4 3\n3 1 2 3 3 6 5\n4 3 2 4 1 1 2 3 4\n5 3 2 4 1 4 3 5 6\n"
        "$EndElements\n");
  const Outcome written =
      run_in(scratch.path(), kProgram + " new mesh --mesh two.msh -o own --grains 50 --no-pack");
  ASSERT_EQ(written.status, 0) << written.errors;
  const std::string text = content(scratch.path() / "own/case.yaml");
  EXPECT_TRUE(has(text, "boundaries (physical curves):  base, seam, top\n")) << text;
  EXPECT_TRUE(has(text, "  - {on: top, pressure: ")) << text;
  EXPECT_FALSE(has(text, "on: seam")) << text;
}

TEST(NewCommand, RefusalsSayWhatToDoAndWriteNothing) {
  const Scratch scratch("new_refused");
  std::filesystem::create_directories(scratch.path() / "full");
  write(scratch.path() / "full/mine.txt", "keep");
  struct Refusal {
    std::string arguments;
    std::string message;
  };
  const Refusal refusals[] = {
      {"triangle -o new",
       "there is no kind 'triangle'; one of biaxial, footing, slope, excavation, quay, element, triaxial, triaxial3d, footing3d, mesh"},
      {"biaxial -o full", "-o full: the folder has files in it"},
      {"biaxial -o full/mine.txt", "-o full/mine.txt: this is a file"},
      {"biaxial -o new --pressure 100kg", "--pressure 100kg: expected a pressure in Pa"},
      {"biaxial -o new --size 0 1", "--size 0: expected a length"},
      {"biaxial -o new --scheme law", "--scheme"},
      {"triaxial3d -o new --elements 100 400",
       "--elements 100 400: 4000000 of them would take 6000 GB of memory; at most 100000 are taken"},
      {"footing -o new --size 1 1", "--size is not for this kind; it takes --scheme, --grains"},
      {"mesh -o new", "name the mesh, --mesh FILE.msh"},
      {"mesh -o new --mesh none.msh", "none.msh"},
      {"mesh -o new --mesh full/mine.txt", "whose name ends in .msh"},
  };
  for (const Refusal& refusal : refusals) {
    const Outcome outcome = run_in(scratch.path(), kProgram + " new " + refusal.arguments);
    EXPECT_EQ(outcome.status, 2) << refusal.arguments;
    EXPECT_TRUE(has(outcome.errors, refusal.message)) << refusal.arguments << ": " << outcome.errors;
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "new")) << refusal.arguments;
  }
  EXPECT_EQ(files_of(scratch.path() / "full"), std::set<std::string>{"mine.txt"});
}

}  // namespace
}  // namespace polargrain::testing
