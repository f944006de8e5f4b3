// SPDX-License-Identifier: GPL-2.0-or-later
// polargrain pack from the specification to the engine's own answer for the exported packing.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::string kProgram = POLARGRAIN;
const std::string kEngine = POLARGRAIN_LIGGGHTS;

TEST(PackCommand, ExportsSpheresThatTheEngineFindsUnderTheirPressure) {
  const Scratch scratch("pack");
  write(scratch.path() / "spheres.yaml",
        "grains: 60\nsizes: {law: uniform, radius: [3 mm, 5 mm]}\ndensity: 2650\ndimension: 3\n"
        "script: cells/spheres_hooke_radii.in\npressure: 100 kPa\nfriction: 0\nseed: 5\n");
  const Outcome made = run_in(scratch.path(), kProgram + " pack spheres.yaml -o spheres.h5");
  ASSERT_EQ(made.status, 0) << made.errors;
  EXPECT_NE(made.out.find("60 grains in "), std::string::npos) << made.out;
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "spheres.h5.log"));
  const Outcome exported = run_in(scratch.path(), kProgram + " pack spheres.h5 --export spheres.data");
  ASSERT_EQ(exported.status, 0) << exported.errors;
  // The engine's own virial over its own volume, none of our averages.
  write(scratch.path() / "look.in",
        "include " + std::filesystem::current_path().string() +
            "/liggghts_inputs/cells/spheres_hooke_radii.in\n"
            "compute s all stress/atom pair\ncompute sum all reduce sum c_s[1] c_s[2] c_s[3]\nthermo_style "
            "custom step vol c_sum[1] c_sum[2] c_sum[3]\n"
            "thermo_modify norm no format float %.10g\nrun 0\n");
  const Outcome looked = run_in(scratch.path(), kEngine + " -in look.in -var packing spheres.data -log none");
  ASSERT_EQ(looked.status, 0) << looked.out;
  std::istringstream lines(looked.out);
  bool found = false;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    double step = 1.0;
    double volume = 0.0;
    double xx = 0.0;
    double yy = 0.0;
    double zz = 0.0;
    if (!(words >> step >> volume >> xx >> yy >> zz) || step != 0.0) continue;
    found = true;
    for (const double virial : {xx, yy, zz}) EXPECT_NEAR(-virial / volume / 1e5, 1.0, 1.5e-3);
  }
  EXPECT_TRUE(found) << looked.out;
}

TEST(PackCommand, ItsEngineNeedsNoFolderOfMpi) {
  // Open MPI's worlds of one process share the name of a folder below TMPDIR: one that started while another removed it
  // failed, once in some hundred runs. In /proc nobody can make one at all.
  const Scratch scratch("pack_no_mpi_folder");
  write(scratch.path() / "discs.yaml",
        "grains: 20\nsizes: {law: uniform, radius: [3 mm, 5 mm]}\ndensity: 2650\nthickness: 1 cm\n"
        "script: cells/hooke_radii.in\npressure: 100 kPa\nfriction: 0\nseed: 5\n");
  const Outcome made = run_in(scratch.path(), "TMPDIR=/proc " + kProgram + " pack discs.yaml -o discs.h5");
  EXPECT_NE(made.out.find("20 grains in "), std::string::npos) << made.out;
  EXPECT_EQ(made.errors.find("ORTE"), std::string::npos) << made.errors;
  // A command that needs a directory says so: the moduli are asked of a worker.
  EXPECT_NE(made.errors.find("set TMPDIR to a directory you may write to"), std::string::npos) << made.errors;
}

/// A case of one material with that script and packing, for `polargrain point`.
void write_material(const Scratch& scratch, const std::string& script, const std::string& packing) {
  write(scratch.path() / "case.yaml",
        "title: one cell\nmesh:\n  rectangle: {size: [1, 1], elements: [1, 1]}\nmaterials:\n  sand: {model: "
        "cell, script: " +
            script + ", packing: " + packing +
            ", G: 16 MPa, Gc: 14 MPa, lc: 20 mm}\nregions: {all: sand}\nboundary:\n"
            "  - {on: bottom, fix: [u1, u2]}\nsteps: {count: 1}\n");
  write(scratch.path() / "path.csv", "h22\n-1e-5\n");
}

/// The small dense packing of these tests, made with cells/hooke_radii.in under 100 kPa.
void make_discs(const Scratch& scratch) {
  write(scratch.path() / "discs.yaml",
        "grains: 60\nsizes: {law: uniform, radius: [3 mm, 7 mm]}\ndensity: 2650\nthickness: 100 mm\n"
        "script: cells/hooke_radii.in\npressure: 100 kPa\nfriction: 0\nseed: 5\n");
  const Outcome made = run_in(scratch.path(), kProgram + " pack discs.yaml -o discs.h5 --quiet");
  ASSERT_EQ(made.status, 0) << made.errors;
}

std::string hooke() {
  return content("liggghts_inputs/cells/hooke_radii.in");
}

std::string replaced(std::string text, const std::string& part, const std::string& other) {
  const std::size_t place = text.find(part);
  EXPECT_NE(place, std::string::npos) << part;
  return text.replace(place, part.size(), other);
}

TEST(PackCommand, PackAndCheckTellTheSameModuli) {
  const Scratch scratch("pack_moduli");
  write(scratch.path() / "discs.yaml",
        "grains: 60\nsizes: {law: uniform, radius: [3 mm, 5 mm]}\ndensity: 2650\nthickness: 100 mm\n"
        "script: cells/hooke_li_chu.in\npressure: 100 kPa\nfriction: 0\nseed: 5\n");
  const Outcome made = run_in(scratch.path(), kProgram + " pack discs.yaml -o discs.h5");
  ASSERT_EQ(made.status, 0) << made.errors;
  write_material(scratch, "cells/hooke_li_chu.in", "discs.h5");
  const Outcome checked = run_in(scratch.path(), kProgram + " check case.yaml");
  ASSERT_EQ(checked.status, 0) << checked.errors;
  const auto moduli = [](const std::string& text) {
    const std::size_t place = text.find("moduli of the packing at rest: G ");
    EXPECT_NE(place, std::string::npos) << text;
    return place == std::string::npos ? "" : text.substr(place, text.find('\n', place) - place);
  };
  EXPECT_EQ(moduli(made.out), moduli(checked.out));
  EXPECT_NE(checked.out.find("material 'sand': moduli"), std::string::npos) << checked.out;
  std::cout << "[figure] " << moduli(made.out) << '\n';
  EXPECT_NE(moduli(made.out).find("couple modulus"), std::string::npos);
}

TEST(PackCommand, AScriptAFifthAsStiffIsRefusedAndSettlingRepairs) {
  const Scratch scratch("pack_soft");
  make_discs(scratch);
  write(scratch.path() / "soft.in", replaced(hooke(), "peratomtypepair 1 6e8", "peratomtypepair 1 1.2e8"));
  write_material(scratch, "soft.in", "discs.h5");
  const std::string point = kProgram + " point case.yaml sand path.csv -o out.csv";
  const Outcome refused = run_in(scratch.path(), point);
  std::cout << "[figure] the message: " << refused.errors;
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.errors.find("soft.in: the packing was recorded under 10"), std::string::npos)
      << refused.errors;
  EXPECT_NE(refused.errors.find("polargrain pack --settle PACKING SCRIPT"), std::string::npos)
      << refused.errors;
  const Outcome settled = run_in(scratch.path(), kProgram + " pack --settle discs.h5 soft.in -o settled.h5");
  ASSERT_EQ(settled.status, 0) << settled.errors;
  EXPECT_NE(settled.out.find("pressure               100.0"), std::string::npos) << settled.out;
  write_material(scratch, "soft.in", "settled.h5");
  const Outcome good = run_in(scratch.path(), point);
  EXPECT_EQ(good.status, 0) << good.errors;
  EXPECT_NE(content(scratch.path() / "out.csv").find("good"), std::string::npos);
}

TEST(PackCommand, SpringsOfAnotherContactModelAreRefusedAndSettlingRepairs) {
  const Scratch scratch("pack_springs");
  make_discs(scratch);
  const Outcome made =  // with friction, so that tangential springs lie ready in it
      run_in(scratch.path(), kProgram + " pack discs.yaml -o springs.h5 --quiet --set friction=0.3");
  ASSERT_EQ(made.status, 0) << made.errors;
  write(scratch.path() / "rolling.in", content("liggghts_inputs/cells/hooke_rolling.in"));
  write_material(scratch, "rolling.in", "springs.h5");
  const std::string point = kProgram + " point case.yaml sand path.csv -o out.csv";
  const Outcome refused = run_in(scratch.path(), point);
  EXPECT_EQ(refused.status, 1);
  for (const char* const words :
       {"rolling.in): the springs of the contacts that the packing brings do not fit the script",
        "'polargrain pack --settle PACKING SCRIPT -o NEW.h5'"})
    EXPECT_NE(refused.errors.find(words), std::string::npos) << refused.errors;
  const Outcome settled =
      run_in(scratch.path(), kProgram + " pack --settle springs.h5 rolling.in -o settled.h5");
  ASSERT_EQ(settled.status, 0) << settled.errors;
  write_material(scratch, "rolling.in", "settled.h5");
  const Outcome good = run_in(scratch.path(), point);
  EXPECT_EQ(good.status, 0) << good.errors;
}

TEST(PackCommand, AScriptAHundredthAsStiffCannotBeSettledIntoACell) {
  const Scratch scratch("pack_softest");
  make_discs(scratch);
  write(scratch.path() / "soft.in", replaced(hooke(), "peratomtypepair 1 6e8", "peratomtypepair 1 6e6"));
  const Outcome settled = run_in(scratch.path(), kProgram + " pack --settle discs.h5 soft.in -o settled.h5");
  EXPECT_EQ(settled.status, 1);
  EXPECT_NE(settled.errors.find("the contacts are too soft for the pressure"), std::string::npos)
      << settled.errors;
}

TEST(PackCommand, HertzOnAHookePackingIsRefusedAndSettlingRepairs) {
  const Scratch scratch("pack_hertz");
  make_discs(scratch);
  const std::string law = hooke();
  const std::size_t begin = law.find("fix             contact_modulus");
  const std::size_t end = law.find("# tan(0.5 rad)");
  write(scratch.path() / "hertz.in",
        replaced(law.substr(0, begin) +
                     "hard_particles yes\n"
                     "fix modulus all property/global youngsModulus peratomtype 5e9\n"
                     "fix poisson all property/global poissonsRatio peratomtype 0.2\n"
                     "fix restitution all property/global coefficientRestitution peratomtypepair 1 0.5\n" +
                     law.substr(end),
                 "hooke/radii", "hertz"));
  write_material(scratch, "hertz.in", "discs.h5");
  const std::string point = kProgram + " point case.yaml sand path.csv -o out.csv";
  const Outcome refused = run_in(scratch.path(), point);
  std::cout << "[figure] the message: " << refused.errors;
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.errors.find("hertz.in: the packing was recorded under"), std::string::npos)
      << refused.errors;
  const Outcome settled = run_in(scratch.path(), kProgram + " pack --settle discs.h5 hertz.in -o settled.h5");
  ASSERT_EQ(settled.status, 0) << settled.errors;
  write_material(scratch, "hertz.in", "settled.h5");
  const Outcome good = run_in(scratch.path(), point);
  EXPECT_EQ(good.status, 0) << good.errors;
}

TEST(PackCommand, ShakenGrainsAreRefused) {
  const Scratch scratch("pack_shaken");
  std::istringstream grains(content("cases/biaxial/packing400.csv"));
  std::ostringstream shaken;
  shaken.precision(12);
  std::string line;
  for (int number = 0; std::getline(grains, line); ++number) {
    if (number == 0) line = replaced(line, " p=1e5", "");  // nothing recorded: they must give themselves away
    std::istringstream words(line);
    std::string id;
    double x = 0.0;
    if (number > 1 && std::getline(words, id, ',') && words >> x) {
      std::string rest;
      std::getline(words, rest);
      shaken << id << "," << x + 2e-4 * std::sin(1.0 + 1.7 * number * number) << rest << "\n";
    } else {
      shaken << line << "\n";
    }
  }
  write(scratch.path() / "shaken.csv", shaken.str());
  write_material(scratch, "cells/hooke_radii.in", "shaken.csv");
  const Outcome refused = run_in(scratch.path(), kProgram + " point case.yaml sand path.csv -o out.csv");
  std::cout << "[figure] the message: " << refused.errors;
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.errors.find("the packing is not at rest: unbalanced force ratio"), std::string::npos)
      << refused.errors;
  const Outcome settled =
      run_in(scratch.path(), kProgram +
                                 " pack --settle shaken.csv cells/hooke_radii.in -o settled.h5 "
                                 "--set pressure=100e3");
  ASSERT_EQ(settled.status, 0) << settled.errors;
}

TEST(PackCommand, GrainsThatTouchOnTwoSidesOfTheirBoxAreNoPackingWithFriction) {
  const Scratch scratch("pack_twofold");
  write(scratch.path() / "spheres.in", content("liggghts_inputs/cells/spheres_hooke_radii.in"));
  const std::string specification =
      "grains: 4\ndimension: 3\nsizes: {law: uniform, radius: [4 mm, 6 mm]}\ndensity: 2650\nscript: spheres.in\n"
      "pressure: 100 kPa\nseed: 1\n";
  write(scratch.path() / "few.yaml", specification + "friction: 0\n");
  const Outcome made = run_in(scratch.path(), kProgram + " pack few.yaml -o few.h5 --quiet");
  EXPECT_EQ(made.status, 0) << made.errors;
  const Outcome refused =
      run_in(scratch.path(), kProgram + " pack few.yaml -o rough.h5 --quiet --set friction=0.3");
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.errors.find("touch on two sides of a box"), std::string::npos) << refused.errors;
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "rough.h5"));
}

}  // namespace
}  // namespace polargrain::testing
