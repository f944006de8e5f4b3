// SPDX-License-Identifier: GPL-2.0-or-later
// Values that cannot be right at all: a fault with its line, in words that one can act on.
#include "app/pack/read_specification.hpp"
#include "tests/support/careless_scenes.hpp"

namespace polargrain::testing {
namespace {

const std::string kPacking = R"(title: Discs
grains: 100
sizes: {law: sieve, diameter: [6 mm, 8 mm, 10 mm], passing: [0, 50 %, 100 %]}
density: 2650
thickness: 100 mm
script: cell.in
pressure: 100 kPa
friction: 0
seed: 1
)";

std::string faults_of(const std::string& text, bool packing) {
  const std::string source = POLARGRAIN_SOURCE_DIRECTORY;
  const Scratch scratch("careless_faults");
  const std::filesystem::path& at = scratch.path();
  write(at / "case.yaml", text);
  const std::string script = content(source + "/liggghts_inputs/cells/hooke_radii.in");
  write(at / "cell.in", script);
  write(at / "cgs.in", replaced(script, "units           si", "units           cgs"));
  write(at / "open.in", replaced(script, "boundary        p p p", "boundary        f p p"));
  write(at / "same.in",
        replaced(replaced(script, "units           si", "units si # not cgs"), "p p p", "pp p p"));
  write(at / "spheres.in", content(source + "/liggghts_inputs/cells/spheres_hooke_radii.in"));
  std::filesystem::copy_file(source + "/cases/footing_cells/packing100.h5", at / "grains.h5");
  try {
    if (packing)
      app::read_packing_specification(at / "case.yaml", {}, {});
    else
      coupler::read_case(at / "case.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

struct Fault {
  std::string name, base, good, bad, message;
};

void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.name;
}

class CarelessFaultTest : public ::testing::TestWithParam<Fault> {};

TEST_P(CarelessFaultTest, IsFound) {
  const Fault& fault = GetParam();
  const std::string found = faults_of(replaced(fault.base, fault.good, fault.bad), fault.base == kPacking);
  EXPECT_NE(found.find(fault.message), std::string::npos) << found;
}

INSTANTIATE_TEST_SUITE_P(
    All, CarelessFaultTest,
    ::testing::Values(
        Fault{"SecondDocument", kGrains,
              "output:", "---\noutput:", "case.yaml:18: a second document begins here"},
        Fault{"BehindTheDots", kGrains, "output:", "...\noutput:", "a second document begins here"},
        Fault{"BeyondAllNumbers", kGround, "E: 30 MPa", "E: 1e308 GPa", "E: expected a pressure"},
        Fault{"BeyondAllStiffness", kGround, "E: 30 MPa", "E: 1e20 GPa",
              "E: '1e20 GPa' is larger than any such quantity"},
        Fault{"LengthOfTheSolarSystem", kGround, "lc: 20 cm", "lc: 1e9 km",
              "lc: '1e9 km' is larger than any such quantity"},
        Fault{"OnePointAndNoLength",
              replaced(kGround, "elements: [20, 10]}", "elements: [20, 10]}\n  element: Q4R"), "lc: 20 cm",
              "lc: 0", "lc: must be above zero with Q4R"},
        Fault{"ExplicitTooFast", kGrains, "{count: 20, tolerance: 1e-2}",
              "{count: 20, method: explicit, pace: 1e-2}",
              "a boundary would run into its elements like a hammer"},
        Fault{"ScriptForSpheres", kGrains, "script: cell.in", "script: spheres.in",
              "the script is for spheres in space (dimension 3), and the packing is one of discs in a plane"},
        Fault{"ScriptInCentimetres", kGrains, "script: cell.in", "script: cgs.in",
              "cgs.in:7: the script is in units cgs, and a cell is in SI; write 'units si'"},
        Fault{"PackingInCentimetres", kPacking, "script: cell.in", "script: cgs.in",
              "cgs.in:7: the script is in units cgs"},
        Fault{
            "ScriptThatIsNotPeriodic", kGrains, "script: cell.in", "script: open.in",
            "open.in:11: the box of a cell is periodic in all directions, and the script has 'boundary f p p'"},
        Fault{"MohrCoulomb", kGround, "model: elastoplastic", "model: mohr_coulomb",
              "did you mean 'elastoplastic'?"},
        Fault{"DirectionByLetter", kGround, "fix: [u1, u2]", "fix: [u1, uy]", "did you mean 'u2'?"},
        Fault{"MovementByLetter", kGrains, "move: {u2:", "move: {uy:", "did you mean 'u2'?"},
        Fault{"DensityInGrams", kPacking, "density: 2650", "density: 2.65", "write 2650 if it was in g/cm3"},
        Fault{"DensityInGramsPerCubicMetre", kPacking, "density: 2650", "density: 2650000",
              "is heavier than any grain (quartz 2650); write 2650 if it was in g/m3"},
        Fault{"SievesWithoutUnit", kPacking, "[6 mm, 8 mm, 10 mm]", "[6, 8, 10]",
              "'6' without a unit is 6 m; write '6 mm'"},
        Fault{"PressureWithoutUnit", kPacking, "100 kPa", "100",
              "'100' without a unit is 100 Pa, the weight of 5.6 mm of soil; write '100 kPa'"},
        Fault{"PackingOfDiscsUnderSpheres", kPacking, "script: cell.in", "script: spheres.in",
              "the script is for spheres in space"}),
    [](const auto& info) { return info.param.name; });

TEST(CarelessFaults, WhatIsRightHasNone) {
  EXPECT_EQ(faults_of(kGrains, false), "no fault");
  EXPECT_EQ(faults_of(kGround, false), "no fault");
  EXPECT_EQ(faults_of(replaced(kGround, "lc: 20 cm", "lc: 0"), false), "no fault");
  EXPECT_EQ(faults_of(kPacking, true), "no fault");
  EXPECT_EQ(faults_of(replaced(kGrains, "script: cell.in", "script: same.in"), false), "no fault");
  EXPECT_EQ(faults_of("---\n" + kGrains + "...\n# the end\n", false), "no fault");
  EXPECT_EQ(faults_of(replaced(kGrains, "100 kPa}", "100 kN/m2}"), false), "no fault");
}

}  // namespace
}  // namespace polargrain::testing
