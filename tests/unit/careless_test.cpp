// SPDX-License-Identifier: GPL-2.0-or-later
// Scenes with one thing wrong each, all of which run and give a plausible figure: every one must be remarked on, and the
// remark must name it.
#include <fmt/format.h>

#include <numbers>
#include <sstream>

#include "tests/support/careless_scenes.hpp"

namespace polargrain::testing {
namespace {

using app::Rank;

class CarelessTest : public ::testing::TestWithParam<Careless> {};

TEST_P(CarelessTest, IsTold) {
  const app::Remarks remarks = remarks_of(GetParam());
  bool told = false;
  for (std::size_t k = 0; k < std::min(remarks.size(), app::kRemarksShown); ++k)
    told = told || (app::line_of(remarks[k]).find(GetParam().message) != std::string::npos &&
                    remarks[k].rank == GetParam().rank && !remarks[k].remedy.empty() &&
                    (remarks[k].at.line > 0 || !GetParam().script_good.empty()));
  EXPECT_TRUE(told) << GetParam().message << "\n" << app::text_of(remarks, true);
}

const std::string kSides = "  - {on: [left, right], pressure: 100 kPa}\n";
const std::string kTop = "  - {on: top, fix: [u1], move: {u2: -8 mm}}\n";
const std::string kCell = "lc: 8 mm}";
const std::string kWeight = "  - {unit_weight: 18 kN/m3}\n";

INSTANTIATE_TEST_SUITE_P(
    StressOfThePacking, CarelessTest,
    ::testing::Values(Careless{"HalfTheSurcharge", kGrains, "pressure: 100 kPa}", "pressure: 50 kPa}",
                               "'left' carries 50 kPa at time zero, its grains 100 kPa"},
                      Careless{"TwiceTheSurcharge", kGrains, "pressure: 100 kPa}", "pressure: 200 kPa}",
                               "its grains 100 kPa"},
                      Careless{"PressureThatPulls", kGrains, "pressure: 100 kPa}", "pressure: -100 kPa}",
                               "pulls, and the material there has no such strength"},
                      Careless{"PascalsForKilopascals", kGrains, "pressure: 100 kPa}", "pressure: 100}",
                               "'100' has no unit and is 100 Pa"},
                      Careless{"ForgottenSurcharge", kGrains, kSides, "",
                               "'left' carries nothing at time zero, its grains 100 kPa"},
                      Careless{"OneSideForgotten", kGrains, "[left, right], pressure", "right, pressure",
                               "'left' carries nothing"},
                      Careless{"BaseThatNobodyHolds", kGrains, "{on: bottom, fix: [u1, u2]}",
                               "{on: [bottom_left, bottom_right], fix: [u1, u2]}",
                               "'bottom' carries nothing"},
                      Careless{"RampFromZero", kGrains, "pressure: 100 kPa}",
                               "pressure: [[0, 0], [1, 100 kPa]]}", "carries 0 kPa at time zero"},
                      Careless{"MegapascalsForKilopascals", kGrains, "pressure: 100 kPa}",
                               "pressure: 100 MPa}", "carries 100 MPa at time zero"},
                      Careless{"TractionInTheWrongPlace", kGrains, "pressure: 100 kPa}",
                               "traction: {u1: 100 kPa}}", "at time zero, its grains 100 kPa"},
                      Careless{"TopLoadedOtherThanTheSides", kGrains, kTop,
                               "  - {on: top, pressure: 20 kPa}\n", "'top' carries 20 kPa"}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Sizes, CarelessTest,
    ::testing::Values(
        Careless{"LengthOfMetres", kGrains, kCell, "lc: 5 m}", "lc is 5e+03 mm"},
        Careless{"LengthOfAGrainOfDust", kGrains, kCell, "lc: 0.01 mm}", "2e+03 times lc (at most 2.5)",
                 Rank::doubtful},
        Careless{"MeshInMillimetres", kGrains, "[0.2 m, 0.4 m]", "[200 m, 400 m]",
                 "the elements of region 'all' measure 2e+04 mm", Rank::doubtful},
        Careless{"MovementInMetres", kGrains, "-8 mm", "-8", "'top' moves by 8000 mm, 2e+03 % of the body"},
        Careless{"PlasticLengthInMetres", kGrains, kCell, "lc: 8 mm, lp: 0.5 m}", "lp is 500 mm",
                 Rank::doubtful},
        Careless{"CoarseElements", kGrains, "elements: [10, 20]", "elements: [2, 4]",
                 "12.5 times lc (at most 2.5)", Rank::doubtful},
        Careless{
            "PulledForPushed", kGrains, "-8 mm", "8 mm",
            "'top' pulls the body apart: at the end it is 2 % longer along 2, 6.4 elastic strains of 'sand' (0.31 "
            "%); the title speaks of compression; to compress, write 'move: {u2: -8 mm}'"},
        Careless{
            "PulledSideways",
            replaced(replaced(kGrains, "title: Compression of b", "title: B"), "bottom, fix: [u1, u2]",
                     "bottom, fix: [u2]"),
            kTop + kSides,
            "  - {on: left, fix: [u1]}\n  - {on: right, move: {u1: 8 mm}}\n  - {on: top, pressure: 100 kPa}\n",
            "'right' pulls the body apart: at the end it is 4 % longer along 1", Rank::doubtful},
        Careless{"PulledBetweenHeldSides", replaced(kGrains, "{u2: -8 mm}", "{u2: 8 mm}"),
                 "{on: [left, right], pressure: 100 kPa}", "{on: [left, right], fix: [u1]}",
                 "and its other sides are held: nothing is left of its stress"},
        Careless{"LawPulledForPushed", replaced(kGrains, "-8 mm", "8 mm"),
                 "{model: cell, script: cell.in, packing: grains.h5, lc: 8 mm}",
                 "{model: elastoplastic, E: 30 MPa, nu: 0.25, Gc: 12 MPa, lc: 8 mm, friction_angle: 30 deg, "
                 "dilatancy_angle: 0, cohesion: 0, confining: 100 kPa}",
                 "4.8 elastic strains of 'sand' (0.42 %)"},
        Careless{"OneStep", kGrains, "count: 20", "count: 1", "elastic strains of the packing",
                 Rank::doubtful},
        Careless{"ManyPerCentInSmallDeformation", kGrains, "-8 mm", "-80 mm", "in small deformation",
                 Rank::doubtful},
        Careless{"LongMonths", replaced(kGrains, "count: 20", "count: 5000"), "elements: [10, 20]",
                 "elements: [200, 400]", "days of one core", Rank::costly},
        Careless{"TinyBody", kGrains, "[0.2 m, 0.4 m]", "[0.2 mm, 0.4 mm]", "mean diameters wide",
                 Rank::doubtful},
        Careless{"LawMovedByAThird", kGround, "pressure: [[0, 10 kPa], [1, 60 kPa]]}",
                 "pressure: 10 kPa}\n  - {on: top_left, move: {u2: -2}}",
                 "'top_left' moves by 2000 mm, 40 % of the body", Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Balance, CarelessTest,
    ::testing::Values(
        Careless{"PressureOnWhatMoves", kGrains, kTop, kTop + "  - {on: top, pressure: 100 kPa}\n",
                 "the pressure on 'top' has no effect"},
        Careless{"TractionOnARoller", kGround, "body:", "  - {on: left, traction: {u1: 5 kPa}}\nbody:",
                 "the traction along 1 on 'left' has no effect"},
        Careless{"WeightInBoxesOfOnePressure", kGrains, "steps:", "body: [{unit_weight: 900 kN/m3}]\nsteps:",
                 "all its boxes of grains are packed under 100 kPa"},
        Careless{"OtherWeightThanTheStress", kGround, kWeight, "  - {unit_weight: 28 kN/m3}\n",
                 "a unit weight of 18 kN/m3, and region 'all' has 28 kN/m3 below body"},
        Careless{"SurchargeThatIsNotThere", kGround, ", surcharge: 10 kPa", "",
                 "'top' carries 10 kPa at time zero, the initial stress behind it 0 kPa"},
        Careless{
            "RollingWithoutAModel", kGrains, "", "",
            "coefficientRollingFriction is given, and no model of pair_style", Rank::wrong, "pair_style ",
            "fix rolling all property/global coefficientRollingFriction peratomtypepair 1 0.4\npair_style "},
        Careless{"CohesionWithoutAModel", kGrains, "", "", "cohesionEnergyDensity is given", Rank::wrong,
                 "pair_style ",
                 "fix glue all property/global cohesionEnergyDensity peratomtypepair 1 1e4\npair_style "},
        Careless{"ResidualOfHalf", kGrains, "tolerance: 1e-2", "tolerance: 0.4",
                 "tolerance: 0.4 of the forces may be out of balance"},
        Careless{"GrainsThatFly", kGrains, kCell, "lc: 8 mm, inertial_number: 0.09}",
                 "inertial_number: 0.09 is the rate"},
        Careless{"SofteningWithoutALength", kGrains, "continuum: cosserat", "continuum: cauchy",
                 "'cauchy' has no length", Rank::doubtful},
        Careless{"UnitLostInAFormula", kGrains, "(0.2 m * 100 kPa)", "(0.2 m * 100)",
                 "'100' in '-top_force / (0.2 m * 100)' has no unit"},
        Careless{"OtherUnitInAFormula", kGrains, "(0.2 m * 100 kPa)", "(0.2 m * 100 MPa)",
                 "times off every pressure of the case"},
        Careless{"MillimetresInAFormula", kGrains, "(0.2 m * 100 kPa)", "(0.2 mm * 100 kPa)",
                 "'0.2 mm' is far from every length"},
        Careless{"SumOfForceAndLength", kGrains, "-shortening / 0.4 m", "(shortening + top_force) / 0.4 m",
                 "adds m and N/m"}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    OtherHabits, CarelessTest,
    ::testing::Values(
        Careless{"FrictionInPerCent", kGrains, "", "", "coefficientFriction is 50, beyond 0 to 2",
                 Rank::wrong, "0.5463024898437905", "50"},
        Careless{"NeighboursOfMetres", kGrains, "", "", "neighbours are listed up to", Rank::costly,
                 "${neighbour_distance} bin", "0.1 bin"},
        Careless{"WeightUpwards", kGround, "unit_weight: 18 kN/m3}\ninitial",
                 "force: [0, 18 kN/m3]}\ninitial", "it lifts the body"},
        Careless{"WeightInNewtons", kGround, "unit_weight: 18 kN/m3}\ninitial",
                 "unit_weight: 18 N/m3}\ninitial", "a weight of 0.018 kN/m3"},
        Careless{"StiffnessInKilopascals", kGround, "E: 30 MPa", "E: 30 kPa",
                 "that alone is an elastic strain of"},
        Careless{"StiffnessOfNeutronStars", kGround, "E: 30 MPa", "E: 30000 GPa", "an elastic strain of"},
        Careless{"RollerForgotten", kGround, "[left, right], fix", "left, fix", "'right' carries nothing"},
        Careless{
            "RollerForgottenWithoutStress",
            replaced(
                kGround,
                "initial_stress:\n  - {surface: 5 m, unit_weight: 18 kN/m3, K0: 0.5, surcharge: 10 kPa}\n",
                ""),
            "[left, right], fix", "left, fix", "its upper end along 1 is free over the whole height"},
        Careless{"AHeavierStressThanTheBody", kGround, "surface: 5 m, unit_weight: 18 kN/m3",
                 "surface: 5 m, unit_weight: 24 kN/m3",
                 "a unit weight of 24 kN/m3, and region 'all' has 18 kN/m3 below body", Rank::doubtful},
        Careless{"ALighterStressThanTheBody", kGround, "surface: 5 m, unit_weight: 18 kN/m3",
                 "surface: 5 m, unit_weight: 8 kN/m3",
                 "a unit weight of 8 kN/m3, and region 'all' has 18 kN/m3 below body"},
        Careless{
            "APullOfAStage", replaced(kGround, "[[0, 10 kPa], [1, 60 kPa]]", "10 kPa"),
            "steps: {count: 10, tolerance: 1e-6}",
            "steps: {tolerance: 1e-6, stages: [{name: a, count: 2}, {name: b, count: 2, boundary: [{on: top, "
            "pressure: -40 kPa}]}]}",
            "a pressure of -30 kPa on 'top' pulls"},
        Careless{"APullInBetween", kGround, "[[0, 10 kPa], [1, 60 kPa]]",
                 "[[0, 10 kPa], [0.2, -40 kPa], [0.4, 10 kPa], [1, 60 kPa]]",
                 "a pressure of -40 kPa on 'top' pulls"},
        Careless{
            "AWholeInPlaceOfAnIncrease", kGround, "steps: {count: 10, tolerance: 1e-6}",
            "steps: {tolerance: 1e-6, stages: [{name: a, until: 1, count: 4, boundary: [{on: top, pressure: 20 kPa}]}, "
            "{name: b, until: 2, count: 4, boundary: [{on: top, pressure: 50 kPa}]}]}",
            "stage 'b' adds 50 kPa on 'top' to the 20 kPa of stage 'a': 70 kPa together", Rank::doubtful},
        Careless{
            "AWholeInPlaceOfAnIncreaseOfTheCase", replaced(kGround, "[[0, 10 kPa], [1, 60 kPa]]", "10 kPa"),
            "steps: {count: 10, tolerance: 1e-6}",
            "steps: {tolerance: 1e-6, stages: [{name: a, until: 1, count: 4}, {name: b, until: 2, count: 4, boundary: [{on: top, "
            "pressure: 16 kPa}]}]}",
            "stage 'b' adds 16 kPa on 'top' to the 10 kPa of the case's own list: 26 kPa together",
            Rank::doubtful},
        Careless{"RatioAtRestInPerCent", kGround, "K0: 0.5", "K0: 50",
                 "the ratios that material 'soil' can carry"},
        Careless{"RatioAtRestOfNothing", kGround, "K0: 0.5", "K0: 0.05",
                 "the ratios that material 'soil' can carry"},
        Careless{"PlaneStress", kGround, "{surface: 5 m, unit_weight: 18 kN/m3, K0: 0.5, surcharge: 10 kPa}",
                 "{stress: [-10 kPa, -10 kPa, 0, 0]}", "s33 is zero"},
        Careless{"TensionForCompression", kGround,
                 "{surface: 5 m, unit_weight: 18 kN/m3, K0: 0.5, surcharge: 10 kPa}",
                 "{stress: [10 kPa, 10 kPa, 10 kPa, 0]}", "stresses are positive in tension"},
        Careless{"SurfaceElsewhere", kGround, "surface: 5 m", "surface: 50 m", "the surface is at 50 m"},
        Careless{"AngleOfHalfADegree", kGround, "30 deg, dilatancy_angle: 5 deg",
                 "0.5 deg, dilatancy_angle: 0.1 deg", "a friction angle of 0.5 deg"},
        Careless{"CohesionInMegapascals", kGround, "cohesion: 10 kPa", "cohesion: 10 MPa",
                 "the body stays elastic", Rank::doubtful},
        Careless{"ReactionOfAFreeSide", kGrains, "{on: top, reaction: u2}", "{on: left, reaction: u2}",
                 "prescribed at 2 of its 41 nodes only"},
        Careless{"DisplacementOfTheBase", kGrains, "{on: top, displacement: u2}",
                 "{on: bottom, displacement: u2}", "the displacement stays zero"},
        Careless{
            "MeasureOfWhatIsFixed", kGrains, "{count: 20, tolerance: 1e-2}",
            "{tolerance: 1e-2, stages: [{measure: {on: bottom, displacement: u2}, grow: 1 mm, count: 5}]}",
            "it cannot grow"},
        Careless{"OutputBeyondTheEnd", kGrains, "every: 5", "every: 50", "fields are written every 50 steps",
                 Rank::costly},
        Careless{"LoadThatComesTooLate", kGround, "[1, 60 kPa]", "[2, 60 kPa]", "the steps end at time 1",
                 Rank::doubtful},
        Careless{"NothingChanges", kGround, "[[0, 10 kPa], [1, 60 kPa]]", "10 kPa",
                 "no load and no movement changes"},
        Careless{"StepsBehindTheMovement", kGrains, "{count: 20, tolerance: 1e-2}",
                 "{tolerance: 1e-2, stages: [{until: 2, count: 40}]}",
                 "in the last 20 of 40 steps no load and no movement changes", Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

const std::string kInItsStress = "{surface: 5 m, unit_weight: 18 kN/m3, K0: 0.5, surcharge: 10 kPa}";
const std::string kPressureOnTop = "pressure: [[0, 10 kPa], [1, 60 kPa]]";

INSTANTIATE_TEST_SUITE_P(
    InAHurry, CarelessTest,
    ::testing::Values(Careless{"HeightForWidth", kGrains, "(0.2 m * 100 kPa)", "(0.4 m * 100 kPa)",
                               "'0.4 m' is the height of the body", Rank::doubtful},
                      Careless{"MillimetresWithoutAUnit", kGrains, "-shortening / 0.4 m", "-shortening / 400",
                               "'400' in '-shortening / 400' has no unit, and a side of the body is 400 mm"},
                      Careless{"WidthForHeight", kGrains, "-shortening / 0.4 m", "-shortening / 0.2 m",
                               "'0.2 m' is the width of the body", Rank::doubtful},
                      Careless{"TractionUpwards", kGround, kPressureOnTop,
                               "traction: {u2: [[0, 10 kPa], [1, 60 kPa]]}",
                               "a traction of 60 kPa on 'top' pulls"},
                      Careless{"PascalsInATable", kGround, "[[0, 10 kPa], [1, 60 kPa]]", "[[0, 10], [1, 60]]",
                               "'60' has no unit and is 60 Pa"},
                      Careless{"WeightOnGroundWithoutStress",
                               replaced(kGround, "initial_stress:\n  - " + kInItsStress + "\n", ""), "", "",
                               "it has no stress then", Rank::doubtful},
                      Careless{"ForceOnEachNode", kGround, kPressureOnTop,
                               "pressure: 10 kPa, node_force: {u2: [[0, 0], [1, -50 kN/m]]}",
                               "each of the 41 nodes of 'top'", Rank::doubtful},
                      Careless{"CoupleModulusInKilopascals", kGround, "Gc: 12 MPa", "Gc: 12 kPa",
                               "Gc is 0.012 MPa", Rank::doubtful},
                      Careless{"ElementsSmallerThanGrains", kGrains, "elements: [10, 20]",
                               "elements: [150, 300]", "a grain is larger than the elements", Rank::doubtful},
                      Careless{"MovementInMicrometres", kGrains, "-8 mm", "-8 um",
                               "its stress changes by less than grains answer to", Rank::doubtful},
                      Careless{"OneStepOfALaw", kGround, "count: 10", "count: 1", "the curve has one point",
                               Rank::doubtful},
                      Careless{"NoiseThatCoversAll", kGrains, "tolerance: 1e-2", "tolerance: 1e-2, noise: 50",
                               "times the noise of the stresses"},
                      Careless{"ToleranceOfALaw", kGround, "tolerance: 1e-6", "tolerance: 0.03",
                               "of the forces may be out of balance", Rank::doubtful},
                      Careless{"TensionNormalToThePlane", kGround, kInItsStress,
                               "{stress: [-10 kPa, -10 kPa, 10 kPa, 0]}",
                               "ground carries hardly any tension"}),
    [](const auto& info) { return info.param.name; });

// What is held the wrong way, read in the wrong place, or asked too coarsely.
INSTANTIATE_TEST_SUITE_P(
    InTheWrongPlace, CarelessTest,
    ::testing::Values(
        Careless{"RigidTranslation", kGrains, "{on: bottom, fix: [u1, u2]}",
                 "{on: bottom, fix: [u1], move: {u2: -8 mm}}",
                 "all that is given along 2 moves by -8 mm: the body is carried along"},
        Careless{"SidesThatHoldTheGroundUp", kGround, "[left, right], fix: [u1]",
                 "[left, right], fix: [u1, u2]", "u2 is fixed along 'left' and 'right'", Rank::doubtful},
        Careless{"PoissonOfThreePerCent", kGround, "nu: 0.3,", "nu: 0.03,", "nu is 0.03", Rank::doubtful},
        Careless{"ForceAlongTheOtherAxis", kGrains, "reaction: u2}", "reaction: u1}",
                 "no monitor reads the force along it: this one is along u1", Rank::doubtful},
        Careless{"StrainFromTheSide", kGrains, "{on: top, displacement: u2}", "{on: left, displacement: u2}",
                 "goes about twice as far", Rank::doubtful},
        Careless{
            "OneSideOfTwo", kGrains, "  axial_strain:",
            "  widening: {on: right, displacement: u1}\n  lateral_strain: widening / 0.2 m\n  axial_strain:",
            "u1 of 'right' alone, and 'left' opposite is free too", Rank::doubtful},
        Careless{"WeightSideways", kGround, "unit_weight: 18 kN/m3}\ninitial",
                 "force: [-18 kN/m3, 0]}\ninitial", "2 points up: nothing pulls the body down"},
        Careless{"WeightSidewaysWithoutStress",
                 replaced(kGround, "initial_stress:\n  - " + kInItsStress + "\n", ""),
                 "unit_weight: 18 kN/m3}", "force: [-18 kN/m3, 0], factor: [[0, 0], [1, 1]]}",
                 "2 points up: nothing pulls the body down"},
        Careless{"FlatElements", kGround, "elements: [20, 10]", "elements: [400, 2]",
                 "up to 100 times as long as wide (at most 20)", Rank::doubtful},
        Careless{"FrictionOfSixtyDegrees", kGround, "friction_angle: 30 deg", "friction_angle: 60 deg",
                 "a friction angle of 60 deg", Rank::doubtful},
        Careless{"ErrorOfAThird", kGrains, "model: cell,", "model: adaptive, adaptive: {tolerance: 0.3},",
                 "tolerance: 0.3 of the pressure", Rank::doubtful},
        Careless{"SpreadSlipsOfFourPoints", kSpreadGrains, "{count: 20, tolerance: 1e-2}",
                 "{count: 20, method: explicit}", "explicit steps with elements Q8R of 4 points",
                 Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

// Written before the remarks on such places were, and run once they stood.
INSTANTIATE_TEST_SUITE_P(
    InTheWrongPlaceUnseen, CarelessTest,
    ::testing::Values(
        Careless{"PushedFromBothSidesTheSameWay",
                 replaced(replaced(kGrains, "bottom, fix: [u1, u2]", "bottom, fix: [u2]"), kTop,
                          "  - {on: top, pressure: 100 kPa}\n"),
                 kSides, "  - {on: [left, right], move: {u1: -4 mm}}\n",
                 "all that is given along 1 moves by -4 mm"},
        Careless{"OneItemForAllSupports", kGround,
                 "  - {on: bottom, fix: [u1, u2]}\n  - {on: [left, right], fix: [u1]}",
                 "  - {on: [bottom, left, right], fix: [u1, u2]}", "hangs on its sides", Rank::doubtful},
        Careless{"ForceOfTheWall",
                 replaced(replaced(kGround, "{on: bottom, reaction: u2}", "{on: right, reaction: u2}"),
                          "bottom, fix: [u1, u2]", "bottom, fix: [u2]"),
                 "  - {on: [left, right], fix: [u1]}",
                 "  - {on: left, fix: [u1]}\n  - {on: right, fix: [u2], move: {u1: [[0, 0], [1, 5 cm]]}}",
                 "no monitor reads the force along it", Rank::doubtful},
        Careless{"LeftAlone", kGrains,
                 "  axial_strain:", "  narrowing: {on: left, displacement: u1}\n  axial_strain:",
                 "u1 of 'left' alone, and 'right' opposite is free too", Rank::doubtful},
        Careless{"ThinLayers", kGrains, "elements: [10, 20]", "elements: [2, 200]",
                 "50 times as long as wide", Rank::doubtful},
        Careless{"ThreeDecimals", kGround, "nu: 0.3,", "nu: 0.003,", "nu is 0.003", Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

/// The first grains of packing400.csv. @param box its head, xx=... yy=...
std::string few_grains(std::size_t grains, const std::string& box) {
  std::istringstream lines(
      content(std::string(POLARGRAIN_SOURCE_DIRECTORY) + "/cases/biaxial/packing400.csv"));
  std::string line;
  std::getline(lines, line);
  std::string text = replaced(line, "xx=0.1980869253 xy=0 yx=0 yy=0.1966123044", box) + '\n';
  for (std::size_t k = 0; k <= grains && std::getline(lines, line); ++k) text += line + '\n';
  return text;
}

/// Four rows of grains of 5 mm that touch, of this density. @param space spheres in four layers, else discs 0.1 m high
std::string grains_of(double density, bool space) {
  constexpr double kRadius = 5e-3;  // m
  const double volume = std::numbers::pi * kRadius * kRadius * (space ? 4.0 / 3.0 * kRadius : 0.1);
  std::string text =
      space ? "# cell xx=0.04 xy=0 xz=0 yx=0 yy=0.04 yz=0 zx=0 zy=0 zz=0.04 p=1e5\nid,x,y,z,r,mass,Izz\n"
            : "# cell xx=0.04 xy=0 yx=0 yy=0.04 z=0.1 p=1e5\nid,x,y,r,mass,Izz\n";
  const auto place = [](int k) { return (2.0 * k + 1.0) * kRadius; };
  for (int id = 0; id < (space ? 64 : 16); ++id)
    text += fmt::format("{},{},{},{}{},{},1e-6\n", id, place(id % 4), place(id / 4 % 4),
                        space ? fmt::format("{},", place(id / 16)) : "", kRadius, density * volume);
  return text;
}

TEST(CarelessPacking, OfLightOrHeavyGrainsIsTold) {
  for (const bool space : {false, true}) {
    const auto text_on = [space](double density) {
      const std::string source = POLARGRAIN_SOURCE_DIRECTORY;
      const Scratch scratch("careless_density");
      write(scratch.path() / "case.yaml", replaced(kGrains, "grains.h5", "grains.csv"));
      write(scratch.path() / "cell.in", content(source + "/liggghts_inputs/cells/" +
                                                (space ? "spheres_hooke_radii.in" : "hooke_radii.in")));
      write(scratch.path() / "grains.csv", grains_of(density, space));
      const coupler::Case the_case = coupler::read_case(scratch.path() / "case.yaml");
      return app::text_of(app::remarks_on(the_case, std::vector<std::string>{}, {}), true);
    };
    const auto told = [&](double density, const std::string& message) {
      const std::string text = text_on(density);
      return text.find(message) != std::string::npos ? "" : message + " is not in\n" + text;
    };
    EXPECT_EQ(told(2.65e6, "material 'sand': the grains weigh 2.65e+06 kg/m3"), "");
    EXPECT_EQ(told(2.65e-3, "the grains weigh 0.0"), "");
    EXPECT_EQ(text_on(2650.0).find("the grains weigh"), std::string::npos);
  }
}

TEST(CarelessPacking, IsTold) {
  const auto expect = [](const Careless& scene) {
    const std::string text = app::text_of(remarks_of(scene), true);
    EXPECT_NE(text.find(scene.message), std::string::npos) << scene.name << '\n' << text;
  };
  const std::string good = "packing: grains.h5";
  const std::string bad = "packing: grains.csv";
  expect({.name = "TwentyGrains",
          .base = kGrains,
          .good = good,
          .bad = bad,
          .message = "a box has 20 grains",
          .packing = few_grains(20, "xx=0.06 xy=0 yx=0 yy=0.06")});
  expect({.name = "NarrowBox",
          .base = kGrains,
          .good = good,
          .bad = bad,
          .message = "of its largest grains wide (at least 3)",
          .packing = few_grains(60, "xx=0.3 xy=0 yx=0 yy=0.04")});
  expect({.name = "SoftGrains",
          .base = kGrains,
          .good = "",
          .bad = "",
          .message = "grains at rest overlap by 5 % of their radius",
          .mean_overlap = 0.05});
  expect({.name = "HardGrains",
          .base = kGrains,
          .good = "",
          .bad = "",
          .message = "time steps shrink with the root of",
          .mean_overlap = 1e-9});
}

}  // namespace
}  // namespace polargrain::testing
