// SPDX-License-Identifier: GPL-2.0-or-later
// Scenes that look odd and are right: nobody is to be stopped by a remark on them.
#include "tests/support/careless_scenes.hpp"

namespace polargrain::testing {
namespace {

class OddButRightTest : public ::testing::TestWithParam<Careless> {};

TEST_P(OddButRightTest, HasNoRemark) {
  const app::Remarks remarks = remarks_of(GetParam());
  EXPECT_TRUE(remarks.empty()) << app::text_of(remarks, true);
}

const std::string kPressureOfSides = "pressure: 100 kPa}";

INSTANTIATE_TEST_SUITE_P(
    All, OddButRightTest,
    ::testing::Values(
        Careless{"GrainsAsTheyAre", kGrains, "", ""}, Careless{"GroundAsItIs", kGround, "", ""},
        Careless{"UnloadedOverSteps", kGrains, kPressureOfSides, "pressure: [[0, 100 kPa], [1, 60 kPa]]}"},
        Careless{"AlmostThePressure", kGrains, kPressureOfSides, "pressure: 98 kPa}"},
        Careless{"PressureAsTraction", kGrains, "{on: [left, right], pressure: 100 kPa}",
                 "{on: left, traction: {u1: 100 kPa}}\n  - {on: right, traction: {u1: -100 kPa}}"},
        Careless{"InPascals", kGrains, kPressureOfSides, "pressure: 100000}"},
        Careless{"KilonewtonsASquareMetre", kGrains, kPressureOfSides, "pressure: 100 kN/m2}"},
        Careless{"HeldSides", kGrains, "{on: [left, right], pressure: 100 kPa}",
                 "{on: [left, right], fix: [u1]}"},
        Careless{"PerCentInAFormula", kGrains, "-shortening / 0.4 m", "-100 * shortening / 0.4 m"},
        Careless{"KilopascalsByAFactor", kGrains, "-top_force / (0.2 m * 100 kPa)",
                 "-1e-3 * top_force / 0.2 m"},
        Careless{"HalfASpecimen", kGrains, "(0.2 m * 100 kPa)", "(2 * 0.1 m * 100 kPa)"},
        Careless{"WeightOverSteps", kGrains,
                 "steps:", "body: [{unit_weight: 18 kN/m3, factor: [[0, 0], [1, 1]]}]\nsteps:"},
        Careless{"ClassicalGround", kGround, "materials:", "continuum: cauchy\nmaterials:"},
        Careless{"Tied", kGrains, "{on: [left, right], pressure: 100 kPa}", "{on: left, tie: right}"},
        Careless{
            "EarthquakeSideways",
            replaced(
                kGround,
                "initial_stress:\n  - {surface: 5 m, unit_weight: 18 kN/m3, K0: 0.5, surcharge: 10 kPa}\n",
                ""),
            "unit_weight: 18 kN/m3}", "force: [2 kN/m3, -18 kN/m3], factor: [[0, 0], [1, 1]]}"},
        Careless{"PurelyCohesive", kGround,
                 "friction_angle: 30 deg, dilatancy_angle: 5 deg, cohesion: 10 kPa",
                 "friction_angle: 0, dilatancy_angle: 0, cohesion: 60 kPa"},
        Careless{"Submerged", replaced(kGround, "18 kN/m3, K0", "9 kN/m3, K0"), "  - {unit_weight: 18",
                 "  - {unit_weight: 9"},
        Careless{"LengthOfFineSand", kGround, "lc: 20 cm", "lc: 0.2 mm"},
        Careless{"Overconsolidated", kGround, "K0: 0.5", "K0: 1.5"},
        Careless{"LargeDeformation", kGrains, "continuum: cosserat", "deformation: large"},
        Careless{
            "WholeCycles", replaced(kGrains, "count: 20", "count: 32"), "{u2: -8 mm}",
            "{u2: [[0, 0], [0.0625, -1 mm], [0.1875, 1 mm], [0.3125, -1 mm], [0.4375, 1 mm], [0.5625, -1 mm], "
            "[0.6875, 1 mm], [0.8125, -1 mm], [0.9375, 1 mm], [1, 0]]}"},
        Careless{"MeshBelowTheSurface",
                 replaced(kGround, "[[0, 10 kPa], [1, 60 kPa]]", "[[0, 820 kPa], [1, 870 kPa]]"),
                 "surface: 5 m", "surface: 50 m"},
        Careless{
            "LoadsOfStagesThatGrow", kGround, "steps: {count: 10, tolerance: 1e-6}",
            "steps: {tolerance: 1e-6, stages: [{name: a, until: 1, count: 4, boundary: [{on: top, pressure: 40 kPa}]}, "
            "{name: b, until: 2, count: 4, boundary: [{on: top, pressure: 20 kPa}]}]}"},
        Careless{
            "ALoadOnASmallSurcharge", replaced(kGround, "[[0, 10 kPa], [1, 60 kPa]]", "10 kPa"),
            "steps: {count: 10, tolerance: 1e-6}",
            "steps: {tolerance: 1e-6, stages: [{name: a, until: 1, count: 4}, {name: b, until: 2, count: 4, boundary: "
            "[{on: top, pressure: 50 kPa}]}]}"},
        Careless{
            "ALoadThatTakesAnothersPlace", kGround, "steps: {count: 10, tolerance: 1e-6}",
            "steps: {tolerance: 1e-6, stages: [{name: a, until: 1, count: 4, boundary: [{on: top, name: q, pressure: 20 "
            "kPa}]}, {name: b, until: 2, count: 4, end: q, boundary: [{on: top, pressure: 50 kPa}]}]}"},
        Careless{
            "HeldBehindItsLoad", kGround, "steps: {count: 10, tolerance: 1e-6}",
            "steps: {tolerance: 1e-6, stages: [{name: a, until: 1, count: 4}, {name: b, until: 2, count: 4, boundary: "
            "[{on: top, fix: [u2]}]}]}"},
        Careless{"ThirdsInAFormula", kGround, "-base_force / 10 m", "-0.333 * base_force / 10 m"},
        Careless{"PressureInTwoParts", kGrains, "{on: [left, right], pressure: 100 kPa}",
                 "{on: [left, right], pressure: 60 kPa}\n  - {on: [left, right], pressure: 40 kPa}"},
        Careless{"ExtensionByItsTitle", replaced(kGrains, "Compression", "Extension"), "-8 mm", "8 mm"},
        Careless{"ExtensionOfAnElasticStrain", kGrains, "-8 mm", "4 mm"},
        Careless{
            "ConstantVolume",
            replaced(replaced(kGrains, "fix: [u1], move: {u2: -8 mm}", "move: {u2: [[0, 0], [1, -8 mm]]}"),
                     "{on: bottom, fix: [u1, u2]}", "{on: bottom, fix: [u2]}"),
            "{on: [left, right], pressure: 100 kPa}",
            "{on: left, fix: [u1]}\n  - {on: right, move: {u1: [[0, 0], [1, 4.08 mm]]}}"},
        Careless{
            "CarriedAlongAndCompressed",
            replaced(kGrains, "{on: bottom, fix: [u1, u2]}", "{on: bottom, fix: [u1], move: {u2: 8 mm}}"),
            "-8 mm", "4 mm"},
        Careless{"SidewaysUnderPressure",
                 replaced(kGrains, "{on: top, fix: [u1], move: {u2: -8 mm}}",
                          "{on: top, move: {u1: 8 mm}, pressure: 100 kPa}"),
                 "{on: [left, right], pressure: 100 kPa}", "{on: left, tie: right}"},
        Careless{"WallThatGivesWay", replaced(kGround, "bottom, fix: [u1, u2]", "bottom, fix: [u2]"),
                 "[left, right], fix: [u1]}",
                 "left, fix: [u1]}\n  - {on: right, move: {u1: [[0, 0], [1, 25 cm]]}}"},
        Careless{"SymmetricHalf", kGrains, "{on: [left, right], pressure: 100 kPa}",
                 "{on: left, fix: [u1]}\n  - {on: right, pressure: 100 kPa}"},
        Careless{
            "MeanOfBothForces", kGrains, "  stress_ratio: -top_force / (0.2 m * 100 kPa)",
            "  base_force: {on: bottom, reaction: u2}\n  stress_ratio: (base_force - top_force) / 2 / (0.2 m * 100 kPa)"},
        Careless{
            "DifferenceOfBothSides", kGrains, "  axial_strain:",
            "  on_the_right: {on: right, displacement: u1}\n  on_the_left: {on: left, displacement: u1}\n  lateral_strain: (on_the_right - on_the_left) / 0.2 m\n  axial_strain:"},
        Careless{"Associated", kGround, "dilatancy_angle: 5 deg", "dilatancy_angle: 30 deg"},
        Careless{"WeightlessGround",
                 replaced(kGround, "{surface: 5 m, unit_weight: 18 kN/m3, K0: 0.5, surcharge: 10 kPa}",
                          "{stress: [-10 kPa, -10 kPa, -10 kPa, 0]}"),
                 "body:\n  - {unit_weight: 18 kN/m3}\n", ""},
        Careless{"SpreadSlipsOfOnePoint", replaced(kSpreadGrains, "mesh:\n", "mesh:\n  element: Q4R\n"),
                 "{count: 20, tolerance: 1e-2}", "{count: 20, method: explicit}"},
        Careless{"SpreadSlipsOfFourPoints", kSpreadGrains, "", ""},
        Careless{"ExplicitAsItIs", kGrains, "{count: 20, tolerance: 1e-2}", "{count: 20, method: explicit}"},
        Careless{"StrongGrains", kGrains, "", "", "", app::Rank::wrong, "0.5463024898437905", "1.2"},
        Careless{"PauseUnderLoad", replaced(kGrains, "count: 20", "stages: [{until: 3, count: 30}]"),
                 "{u2: -8 mm}", "{u2: [[0, 0], [1, -4 mm], [2, -4 mm], [3, -8 mm]]}"},
        Careless{"TableBeyondTheMeasure", replaced(kGrains, "{u2: -8 mm}", "{u2: [[0, 0], [10, -80 mm]]}"),
                 "count: 20,",
                 "stages: [{measure: {on: top, from: bottom, displacement: u2}, grow: -8 mm, count: 20}],"},
        Careless{"ToleranceOfTheDeepest",
                 replaced(kGrains, "model: cell",
                          "model: adaptive, adaptive: {tolerance: 1 %, reference_pressure: 300 kPa}"),
                 "-8 mm", "-4 mm"},
        Careless{"AnchorThatIsPulled", kGround, "{on: top, pressure: [[0, 10 kPa], [1, 60 kPa]]}",
                 "{on: top, pressure: 10 kPa}\n  - {on: top_right, node_force: {u2: [[0, 0], [1, 5 kN/m]]}}"},
        Careless{
            "RollingWithItsModel", kGrains, "", "", "", app::Rank::wrong,
            "pair_style      gran model hooke/radii tangential history",
            "fix rolling all property/global coefficientRollingFriction peratomtypepair 1 0.4\npair_style gran model hooke/radii tangential history rolling_friction epsd2"}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace polargrain::testing
