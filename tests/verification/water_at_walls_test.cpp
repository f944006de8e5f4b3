// SPDX-License-Identifier: GPL-2.0-or-later
// Water at interfaces, walls and bare faces, through the language of cases, against statics and closed forms.
#include <fmt/format.h>

#include <cmath>

#include "tests/support/case_of_laws.hpp"

using polargrain::testing::RunOfLaws;

namespace {

constexpr double kWeight = 10e3;  // of the water, N/m3

/// A wall of 3 m, held at its foot, on the left of ground that is held all over and slides along it without friction: nothing but
/// water loads the wall.
std::string cantilever(const std::string& boundary, int sides = 3, const std::string& element = "Q8R") {
  return "title: A wall that water alone loads\n"
         "continuum: cauchy\n" +
         fmt::format("mesh: {{element: {}, rectangle: {{size: [2 m, 3 m], elements: [2, {}]}}}}\n", element,
                     sides) +
         "materials: {sand: {model: elastic, E: 20 MPa, nu: 0.3}}\n"
         "regions: {all: sand}\n"
         "water: {unit_weight: 10 kN/m3, permeability: 1e-4 m/s, level: 3 m}\n"
         "interfaces: {skin: {on: left, friction: 0 deg, normal_stiffness: 1e-3 Pa/m, shear_stiffness: 1e-3 Pa/m}}\n"
         "beams: {sheet: {on: left, EA: 3000 MN/m, EI: 20 MNm2/m, clamped: sheet_bottom}}\n"
         "boundary:\n"
         "  - {on: all, fix: [u1, u2]}\n"
         "  - {on: sheet, fix: [u2]}\n"
         "  - {on: sheet_bottom, fix: [u1, u2]}\n"
         "  - {on: right, drained: true}\n" +
         boundary +
         "steps: {duration: 2 a, count: 2, tolerance: 1e-8}\n"  // in the first year the gap of the wall fills
         "monitors: {moment: {beam: sheet, value: moment}, shear: {beam: sheet, value: shear},\n"
         "           push: {interface: skin, value: water}, p: {on: left, water: pressure}}\n";
}

// gw h^3 / 6, gw h^2 / 2: the loads of nodes are consistent, so the foot of a cantilever has all digits.
TEST(WaterAtWalls, ThePoresLoadAWallHydrostatically) {
  const RunOfLaws run(cantilever(""));
  EXPECT_NEAR(std::abs(run.last("moment")), kWeight * 27.0 / 6.0, 1e-9 * kWeight * 27.0);
  EXPECT_NEAR(std::abs(run.last("shear")), kWeight * 9.0 / 2.0, 1e-9 * kWeight * 9.0);
  EXPECT_NEAR(run.last("push"), kWeight * 9.0 / 2.0, 1e-9 * kWeight * 9.0);
  EXPECT_NEAR(run.last("p"), kWeight * 1.5, 1e-6 * kWeight);
}

// The load of the foot's own node is carried too, whatever the share of the wall that it takes.
TEST(WaterAtWalls, TheShearAtTheFootIsAllThatTheWallCarries) {
  for (const std::string element : {"Q8R", "T6"})
    for (const int sides : {1, 2, 3, 7})
      for (const double level : {0.0, 1.3, 3.0, 4.0}) {
        const RunOfLaws run(
            cantilever(fmt::format("  - {{on: sheet, free_water: {} m}}\n", level), sides, element));
        const double above = std::max(level - 3.0, 0.0);
        const double wet = std::min(level, 3.0);
        const double carried = kWeight * (9.0 / 2.0 - wet * wet / 2.0 - above * wet);
        // With all water on both sides the head's shear is the largest: rounding.
        EXPECT_NEAR(std::abs(run.last("shear")), std::abs(carried), 1e-8 * kWeight * 9.0)
            << element << ' ' << sides << ' ' << level;
      }
}

// Free water on the other side, its level in the middle of a side of an element, takes its part away.
TEST(WaterAtWalls, FreeWaterLoadsTheOtherSideUpToItsLevel) {
  for (const double level : {0.4, 1.0, 2.37, 3.0, 3.5}) {
    const RunOfLaws run(cantilever(fmt::format("  - {{on: sheet, free_water: {} m}}\n", level)));
    // Above the wall the water stands over it: a trapezium.
    const double above = std::max(level - 3.0, 0.0);
    const double wet = std::min(level, 3.0);
    const double moment = kWeight * (27.0 / 6.0 - wet * wet * wet / 6.0 - above * wet * wet / 2.0);
    EXPECT_NEAR(std::abs(run.last("moment")), std::abs(moment), 1e-9 * kWeight * 27.0) << level;
  }
}

/// A wall between two grounds of 2 m x 3 m, held all over, with water levels on its far sides.
RunOfLaws two_levels(const std::string& passage, const std::string& element = "Q8R") {
  return RunOfLaws(
      "title: Two levels of water\n"  // in the first year the gap of the wall, which bends, fills
      "continuum: cauchy\n"
      "mesh: {element: " +
      element +
      ", rectangle: {size: [4 m, 3 m], elements: [4, 3], lines: {line: [2 m, 0 m, 2 m, 3 m]}}}\n"
      "materials: {sand: {model: elastic, E: 20 MPa, nu: 0.3}}\n"
      "regions: {all: sand}\n"
      "water: {unit_weight: 10 kN/m3, permeability: 1e-4 m/s, level: 3 m}\n"
      "interfaces: {skin: {on: line, friction: 0 deg, normal_stiffness: 1e-3 Pa/m, shear_stiffness: 1e-3 Pa/m, "
      "water: " +
      passage +
      "}}\n"
      "beams: {sheet: {on: line, EA: 3000 MN/m, EI: 20 MNm2/m, clamped: sheet_bottom}}\n"
      "boundary:\n"
      "  - {on: all, fix: [u1, u2]}\n"
      "  - {on: sheet, fix: [u2]}\n"
      "  - {on: sheet_bottom, fix: [u1, u2]}\n"
      "  - {on: left, water_level: 3 m}\n"
      "  - {on: right, water_level: 5 m}\n"
      "steps: {duration: 2 a, count: 2, tolerance: 1e-9}\n"
      "monitors: {moment: {beam: sheet, value: moment}, in: {on: right, water: flow}, out: {on: left, water: flow},\n"
      "           left: {interface: skin left, value: water}, right: {interface: skin right, value: water}}\n");
}

TEST(WaterAtWalls, AnImperviousWallCarriesTheDifferenceOfTwoLevels) {
  for (const std::string element : {"Q8R", "T6"}) {
    const RunOfLaws run = two_levels("impervious", element);
    EXPECT_NEAR(run.last("left"), kWeight * 4.5, 1e-7 * kWeight) << element;
    EXPECT_NEAR(run.last("right"), kWeight * (4.5 + 6.0), 1e-7 * kWeight) << element;
    EXPECT_NEAR(std::abs(run.last("moment")), kWeight * 2.0 * 9.0 / 2.0, 1e-7 * kWeight) << element;
    EXPECT_NEAR(run.last("in"), 0.0, 1e-12) << element;
  }
}

// Darcy through 4 m and through the wall: q = k dh / L where it is open, dh / (L/k + R) where it leaks.
TEST(WaterAtWalls, ResistancesInSeriesAdd) {
  const RunOfLaws open = two_levels("permeable");
  EXPECT_NEAR(-open.last("in"), 1e-4 * 2.0 / 4.0 * 3.0, 1e-10);
  EXPECT_NEAR(open.last("left"), open.last("right"), 1e-7 * kWeight);
  EXPECT_NEAR(open.last("moment"), 0.0, 1e-7 * kWeight);
  for (const double resistance : {1e2, 4e4, 1e7}) {
    const RunOfLaws leaky = two_levels(fmt::format("leaky, resistance: {} s", resistance));
    const double flow = 2.0 / (4.0 / 1e-4 + resistance);
    EXPECT_NEAR(leaky.last("out"), 3.0 * flow, 1e-6 * 3.0 * flow) << resistance;
    EXPECT_NEAR(leaky.last("right") - leaky.last("left"), kWeight * 3.0 * flow * resistance,
                1e-6 * kWeight * 6.0);
  }
}

/// A strip load on saturated ground with a curve in it that a stage behind the last one would part.
std::string consolidating(const std::string& interface, const std::string& more_stages) {
  return "title: A strip on ground with a joint\n"
         "continuum: cauchy\n"
         "mesh: {rectangle: {size: [6 m, 3 m], elements: [6, 3], lines: {line: [2 m, 1 m, 2 m, 3 m], strip: [0, 3 m, 1 "
         "m, 3 m]}}}\n"
         "materials: {clay: {model: elastic, E: 10 MPa, nu: 0.25}}\n"
         "regions: {all: clay}\n"
         "water: {unit_weight: 10 kN/m3, permeability: 1e-8 m/s}\n" +
         interface +
         "boundary:\n"
         "  - {on: [left, right], fix: [u1]}\n"
         "  - {on: bottom, fix: [u1, u2]}\n"
         "  - {on: top, drained: true}\n"
         "  - {on: strip, pressure: 100 kPa}\n"
         "steps:\n"
         "  tolerance: 1e-11\n"
         "  stages:\n"
         "    - {name: load, until: 1 d, count: 4}\n" +
         more_stages +
         "monitors:\n"
         "  strip: {on: strip, displacement: u2}\n"
         "  bottom: {on: bottom, water: pressure}\n"
         "  side: {on: right, water: pressure}\n"
         "  out: {on: top, water: outflow}\n";
}

// Until it is placed, a curve is no curve, for water and ground; and a permeable joint that is placed moves nothing.
TEST(WaterAtWalls, AJointThatIsTiedLeavesTheDigitsOfTheBody) {
  const RunOfLaws whole(consolidating("", ""));
  for (const std::string passage : {"permeable", "impervious", "leaky, resistance: 1e9 s"}) {
    const RunOfLaws tied(consolidating(
        "interfaces: {skin: {on: line, friction: 30 deg, cohesion: 1 GPa, tension: 1 GPa, water: " + passage +
            "}}\n",
        "    - {name: joint, place: skin, until: 2 d, count: 2}\n"));
    for (const std::string monitor : {"strip", "bottom", "side", "out"})
      for (std::size_t step = 0; step <= 4; ++step)
        EXPECT_NEAR(tied.value(monitor, step), whole.value(monitor, step),
                    1e-9 * std::abs(whole.last(monitor)))
            << passage << ' ' << monitor << ' ' << step;
  }
}

// A permeable joint between equal grounds is no joint as its stiffness grows: the difference falls with it.
TEST(WaterAtWalls, AStiffPermeableJointIsNoJoint) {
  const RunOfLaws whole(consolidating("", ""));
  double before = 0.0;
  for (const double stiffness : {1e11, 1e12}) {
    const RunOfLaws joint(consolidating(
        fmt::format("interfaces: {{skin: {{on: line, friction: 30 deg, cohesion: 1 GPa, tension: 1 GPa, "
                    "normal_stiffness: {0} Pa/m, shear_stiffness: {0} Pa/m}}}}\n",
                    stiffness),
        ""));
    const double difference = std::abs(joint.last("bottom") / whole.last("bottom") - 1.0);
    EXPECT_LT(difference, 2e-4 * 1e11 / stiffness);
    if (before > 0.0) {
      EXPECT_NEAR(difference / before, 0.1, 0.01);
    }
    before = difference;
    EXPECT_NEAR(joint.last("strip"), whole.last("strip"), 1e-3 * std::abs(whole.last("strip")));
  }
}

// The pile parts the water by its interfaces alone: K'/2K of sin(pi s / 2T) = 1/2 at half the depth of the layer.
TEST(WaterAtWalls, FlowPassesUnderASheetPile) {
  const RunOfLaws run(
      "title: Flow under a sheet pile\n"
      "continuum: cauchy\n"
      "mesh: {rectangle: {size: [4 m, 1 m], elements: [64, 16], regions: {before: [0, 0, 2 m, 1 m]}, lines: {pile: [2 m, "
      "0.5 m, 2 m, 1 m], inlet: [2 m, 1 m, 4 m, 1 m], outlet: [0, 1 m, 2 m, 1 m]}}}\n"
      "materials: {sand: {model: elastic, E: 100 MPa, nu: 0.25}}\n"
      "regions: {before: sand, rest: sand}\n"
      "water: {unit_weight: 10 kN/m3, permeability: 1e-4 m/s}\n"
      "interfaces: {skin: {on: pile, friction: 30 deg, cohesion: 1 GPa, tension: 1 GPa, water: impervious}}\n"
      "beams: {sheet: {on: pile, EA: 3000 MN/m, EI: 20 MNm2/m}}\n"
      "boundary:\n"
      "  - {on: [left, right], fix: [u1]}\n"
      "  - {on: bottom, fix: [u1, u2]}\n"
      "  - {on: inlet, pore_pressure: 10 kPa}\n"
      "  - {on: outlet, drained: true}\n"
      "steps: {duration: 1 a, count: 1, tolerance: 1e-8}\n"
      "monitors: {in: {on: inlet, water: flow}, out: {on: outlet, water: flow}}\n");
  EXPECT_NEAR(run.last("in"), -run.last("out"), 1e-6 * run.last("out"));
  // The toe is a singularity: elements of T/16 are 1.3 % high.
  EXPECT_NEAR(run.last("out") / 1e-4, 0.5, 0.01);
}

/// Ground of 12 m x 6 m under water at its surface, with a wall at 4 m and a pit before it.
std::string pit(const std::string& stages, const std::string& passage = "impervious") {
  return "title: A pit in water\n"
         "continuum: cauchy\n"
         "mesh: {rectangle: {size: [12 m, 6 m], elements: [12, 6], regions: {pit: [0, 4 m, 4 m, 6 m]}, lines: {pile: [4 m, "
         "2 m, 4 m, 6 m], floor: [0, 4 m, 4 m, 4 m]}}}\n"
         "materials: {sand: {model: elastic, E: 20 MPa, nu: 0.3}}\n"
         "regions: {pit: sand, rest: sand}\n"
         "water: {permeability: 1e-4 m/s, level: 6 m, unit_weight: 10 kN/m3}\n"
         "interfaces: {skin: {on: pile, friction: 30 deg, cohesion: 1 GPa, tension: 1 GPa, water: " +
         passage +
         "}}\n"
         "beams: {sheet: {on: pile, EA: 3000 MN/m, EI: 20 MNm2/m}}\n"
         "boundary:\n"
         "  - {on: [left, right], fix: [u1]}\n"
         "  - {on: bottom, fix: [u1, u2]}\n"
         "  - {on: right, water_level: 6 m}\n"
         "body: [{unit_weight: 20 kN/m3}]\n"
         "initial_stress: [{surface: 6 m, unit_weight: 20 kN/m3, K0: 0.5}]\n"
         "steps:\n"
         "  tolerance: 1e-9\n"
         "  stages:\n"
         "    - {name: wall, place: sheet, until: 1 d, count: 1}\n" +
         stages +
         "monitors:\n"
         "  base: {on: bottom, reaction: u2}\n"
         "  sides: {on: [left, right, bottom], reaction: u1}\n"
         "  floor: {on: floor, displacement: u2}\n"
         "  head: {on: sheet_top, displacement: u1}\n"
         "  moment: {beam: sheet, value: moment}\n"
         "  earth: {interface: skin right, value: pressure}\n"
         "  water: {interface: skin right, value: water}\n"
         "  in: {on: right, water: flow}\n"
         "  out: {on: floor, water: flow}\n";
}

// A wall that comes where water is takes over the effective stress of the ground, and nothing moves.
TEST(WaterAtWalls, AWallComesIntoWetGroundAtRest) {
  const RunOfLaws run(pit(""));
  EXPECT_NEAR(run.last("head"), 0.0, 1e-12);
  EXPECT_NEAR(run.last("moment"), 0.0, 1e-3);
  EXPECT_NEAR(run.last("water"), 10e3 * 8.0, 1e-4);
  // K0 times the submerged weight; the toe, a sixth of the last side of 1 m, has the stress of the node 0.5 m above it.
  EXPECT_NEAR(run.last("earth"), 0.5 * 10e3 * (8.0 - 0.5 / 6.0), 1e-4);
}

// What stands on the base is ground, the water in it, and the free water in the pit.
TEST(WaterAtWalls, APitIsDugUnderWaterAndPumpedDry) {
  const std::string dig =
      "    - {name: dig, remove: pit, until: 2 d, count: 2, boundary: [{name: sea, on: [floor, sheet], free_water: [[0 d, 6 "
      "m], [2 d, 6 m], [3 d, 4.5 m], [4 d, 3 m]]}]}\n";
  const std::string pump = "    - {name: pump, until: 4 d, count: 4}\n";
  const RunOfLaws run(pit(dig + pump));
  const double ground = 20e3 * (12 * 6 - 4 * 2);
  EXPECT_NEAR(run.value("base", 1), 20e3 * 12 * 6, 1e-6 * ground);
  EXPECT_NEAR(run.value("base", 3), ground + 10e3 * 4 * 2, 1e-6 * ground);
  EXPECT_NEAR(run.value("base", 5), ground + 10e3 * 4 * 0.5, 1e-6 * ground);
  EXPECT_NEAR(run.last("base"), ground, 1e-6 * ground);
  EXPECT_GT(run.value("floor", 3), 0.0);  // the ground below the pit rises
  // Forces along 1 balance: there is no load but water, which stands on the wall as on the ground left of it.
  EXPECT_NEAR(run.last("sides"), 0.0, 1e-6 * ground);
  EXPECT_GT(std::abs(run.last("moment")), 1e3);
  // Water comes in from the right and leaves by the floor: Darcy's order, 2 m over some 10 m.
  EXPECT_LT(run.last("in"), -1e-5);
  EXPECT_NEAR(run.last("in"), -run.last("out"), 1e-4 * std::abs(run.last("out")));
  // Of ground, its water, the interface and the beam; the free water works from outside.
  EXPECT_NEAR(run.last("internal_work") / run.last("external_work"), 1.0, 1e-6);

  for (const int interrupted : {1, 2, 5}) {
    const RunOfLaws again(pit(dig + pump), interrupted);
    for (const std::string monitor : {"base", "head", "moment", "earth", "water", "out"})
      EXPECT_EQ(again.last(monitor), run.last(monitor)) << monitor << interrupted;
  }
}

/// A bed of 2 m below 4 m of water, in stages of the sea.
std::string bed_of_a_sea(const std::string& permeability, const std::string& stages) {
  return "title: A sea that rises and falls\n"
         "continuum: cauchy\n"
         "mesh: {rectangle: {size: [1 m, 2 m], elements: [1, 2]}}\n"
         "materials: {clay: {model: elastic, E: 10 MPa, nu: 0.25}}\n"
         "regions: {all: clay}\n"
         "water: {permeability: " +
         permeability +
         ", level: 4 m, unit_weight: 10 kN/m3}\n"
         "boundary:\n"
         "  - {on: [left, right], fix: [u1]}\n"
         "  - {on: bottom, fix: [u1, u2]}\n"
         "  - {name: sea, on: top, free_water: 4 m}\n"
         "body: [{unit_weight: 20 kN/m3}]\n"
         "initial_stress: [{surface: 2 m, unit_weight: 20 kN/m3, K0: 0.5, surcharge: 20 kPa}]\n"
         "steps:\n"
         "  tolerance: 1e-8\n"
         "  stages:\n"
         "    - {name: rest, until: 1 d, count: 1}\n" +
         stages + "monitors: {u: {on: top, displacement: u2}, p: {on: top, water: pressure}}\n";
}

/// A stage that leads the sea to a level.
std::string sea(const char* name, int until, const char* level) {
  return fmt::format(
      "    - {{name: {}, until: {} d, count: 4, boundary: [{{name: sea, on: top, free_water: {} m}}]}}\n",
      name, until, level);
}

// Free water on a bed leaves effective stress alone, whatever its level: pressures in pores and load go one way along the stage.
TEST(WaterAtWalls, ALevelOfAStageMovesNoGround) {
  const RunOfLaws run(bed_of_a_sea("1e-2 m/s", sea("flood", 11, "10") + sea("ebb", 21, "3")));
  for (std::size_t step = 0; step <= run.steps(); ++step)
    EXPECT_NEAR(run.value("u", step), 0.0, 1e-9)
        << "step " << step << "; 1 kPa more or less moves it by 0.17 mm";
  EXPECT_NEAR(run.value("p", 3), 50e3, 1e-3) << "half way from 4 m to 10 m";
  EXPECT_NEAR(run.value("p", 5), 80e3, 1e-3);
  EXPECT_NEAR(run.last("p"), 10e3, 1e-3);
}

/// A column of 2 m whose water stands at 1.5 m when it begins. @param in_space whether it is a box
std::string dry_bed(bool in_space, const std::string& level, const std::string& bottom = "") {
  return "title: Free water below and above a bed\n"
         "continuum: cauchy\n" +
         std::string(in_space ? "mesh: {box: {size: [1 m, 1 m, 2 m], elements: [1, 1, 2]}, element: H20R}\n"
                              : "mesh: {rectangle: {size: [1 m, 2 m], elements: [1, 4]}}\n") +
         "materials: {clay: {model: elastic, E: 10 MPa, nu: 0.25}}\n"
         "regions: {all: clay}\n"
         "water: {permeability: 1e-5 m/s, level: 1.5 m, unit_weight: 10 kN/m3}\n"
         "boundary:\n"
         "  - {on: [left, right], fix: [u1]}\n" +
         (in_space ? "  - {on: [front, back], fix: [u2]}\n" : "") + "  - {on: bottom, fix: [" +
         (in_space ? "u3" : "u2") + "]" + bottom + "}\n  - {on: top, free_water: " + level +
         "}\n"
         "body: [{unit_weight: 20 kN/m3}]\n"
         "initial_stress: [{surface: 2 m, unit_weight: 20 kN/m3, K0: 0.5}]\n"
         "steps: {duration: 12 d, count: 24, tolerance: 1e-8}\n"
         "monitors: {p: {on: top, water: pressure}, base: {on: bottom, reaction: " +
         (in_space ? "u3" : "u2") + "}, u: {on: top, displacement: " + (in_space ? "u3" : "u2") +
         "}, out: {on: top, water: outflow}, flow: {on: top, water: flow}}\n";
}

// A dry bed has no water to give and no load: with the same level inside and outside all stays at rest.
TEST(WaterAtWalls, FreeWaterBelowABedDoesNothing) {
  for (const bool in_space : {false, true})
    for (const char* const bottom : {"", ", water_level: 1.5 m"}) {
      const RunOfLaws run(dry_bed(in_space, "1.5 m", bottom));
      EXPECT_NEAR(run.last("p"), -5e3, 0.1) << in_space << bottom;
      EXPECT_NEAR(run.last("u"), 0.0, 1e-8) << in_space << bottom;
      EXPECT_NEAR(run.last("out"), 0.0, 1e-7) << in_space << bottom;
      EXPECT_NEAR(run.last("base"), 40e3, 1e-2) << in_space << bottom;
    }
}

// Where water comes from below, it leaves by the dry bed at p = 0: 10 kPa more than at rest, over 2 m.
TEST(WaterAtWalls, WaterLeavesByADryBed) {
  for (const bool in_space : {false, true}) {
    const RunOfLaws run(dry_bed(in_space, "1.5 m", ", pore_pressure: 30 kPa"));
    EXPECT_NEAR(run.last("p"), 0.0, 0.1) << in_space;
    EXPECT_NEAR(run.last("flow"), 1e-5 * 0.5, 1e-5 * 0.5 * 1e-4) << in_space;
  }
}

// A level that rises over a bed and falls below it again.
TEST(WaterAtWalls, ABedIsFloodedAndFallsDry) {
  for (const bool in_space : {false, true}) {
    const RunOfLaws run(
        dry_bed(in_space, "[[0 d, 1.5 m], [1 d, 1.5 m], [5 d, 4 m], [6 d, 4 m], [10 d, 1.5 m]]"));
    EXPECT_NEAR(run.value("p", 2), -5e3, 0.1) << in_space << " before it rises";
    EXPECT_NEAR(run.value("p", 12), 20e3, 1.0) << in_space << " 2 m of water";
    EXPECT_NEAR(run.value("base", 12), 60e3, 1.0) << in_space;
    EXPECT_LT(run.value("out", 12), 0.0) << in_space << " water comes in";
    EXPECT_NEAR(run.last("p"), 0.0, 1.0) << in_space << " dry, and full of water";
    EXPECT_NEAR(run.last("base"), 40e3, 1.0) << in_space;
  }
}

// Stages whose level is below the bed, and above it again: load and pressure go one way along the stage.
TEST(WaterAtWalls, ALevelOfAStageMayLeaveABedDry) {
  const RunOfLaws run(bed_of_a_sea("1e-5 m/s", sea("ebb", 11, "1") + sea("flood", 21, "5")));
  for (std::size_t step = 0; step <= run.steps(); ++step)
    EXPECT_NEAR(run.value("u", step), 0.0, 1e-6) << "step " << step << "; 1 kPa moves it by 0.17 mm";
  EXPECT_NEAR(run.value("p", 3), 10e3, 10.0) << "half way from 2 m of water to nothing";
  EXPECT_NEAR(run.value("p", 5), 0.0, 10.0);
  EXPECT_NEAR(run.last("p"), 30e3, 10.0);
}

// A face that is wet in part, of one element over the height: gw h^2 / 2 and gw h^3 / 6 of the moment, at any level.
TEST(WaterAtWalls, FreeWaterInSpaceEndsAtItsLevel) {
  for (const char* const element : {"H20R", "H20"})
    for (const double level : {0.3, 0.9, 1.0, 1.7, 2.0}) {
      const RunOfLaws run(
          "title: A block in water\n"
          "continuum: cauchy\n"
          "mesh: {box: {size: [1 m, 1 m, 2 m], elements: [1, 1, 1]}, element: " +
          std::string(element) +
          "}\n"
          "materials: {clay: {model: elastic, E: 10 MPa, nu: 0.25}}\n"
          "regions: {all: clay}\n"
          "water: {undrained: true, bulk_modulus: 1 GPa, void_ratio: 0.7, level: 0 m, unit_weight: 10 kN/m3}\n"
          "boundary:\n"
          "  - {on: bottom, fix: [u1, u2, u3]}\n"
          "  - {on: left, free_water: " +
          std::to_string(level) +
          " m}\n"
          "steps: {duration: 1 d, count: 1, tolerance: 1e-8}\n"
          "monitors: {push: {on: bottom, reaction: u1}}\n");
      EXPECT_NEAR(run.last("push"), -0.5 * 10e3 * level * level, 1e-6 * 10e3) << element << ' ' << level;
    }
}

// Corners of ground that has gone do not count.
TEST(WaterAtWalls, AMeanPressureIsOfTheGroundThatIsLeft) {
  const RunOfLaws run(
      "title: Half of the top is dug away\n"
      "continuum: cauchy\n"
      "mesh: {rectangle: {size: [4 m, 4 m], elements: [4, 4], regions: {pit: [0, 2 m, 2 m, 4 m]}, lines: {keep: [2 m, 4 m, 4 m, 4 m]}}}\n"
      "materials: {clay: {model: elastic, E: 10 MPa, nu: 0}}\n"
      "regions: {pit: clay, rest: clay}\n"
      "water: {permeability: 1e-4 m/s, level: 4 m, unit_weight: 10 kN/m3}\n"
      "boundary:\n"
      "  - {on: [left, right], fix: [u1]}\n"
      "  - {on: bottom, fix: [u1, u2]}\n"
      "  - {name: below, on: bottom, drained: true}\n"
      "body: [{unit_weight: 20 kN/m3}]\n"
      "initial_stress: [{surface: 4 m, unit_weight: 20 kN/m3, K0: 0.5}]\n"
      "steps:\n"
      "  tolerance: 1e-6\n"
      "  stages:\n"
      "    - {name: rest, until: 1 d, count: 1}\n"
      "    - {name: dig, remove: pit, until: 10 d, count: 1}\n"
      "    - {name: raise, until: 40 d, count: 1, boundary: [{name: below, on: bottom, water_level: 5 m}]}\n"
      "monitors: {all: {on: top, water: pressure}, left: {on: keep, water: pressure}}\n");
  EXPECT_GT(std::abs(run.last("left")), 1e3);
  EXPECT_DOUBLE_EQ(run.last("all"), run.last("left"));
}

TEST(WaterAtWalls, FaultsNameTheRemedy) {
  const auto fault_of = [](const std::string& stages, const std::string& passage = "impervious") {
    return polargrain::testing::faults_of(pit(stages, passage));
  };
  const auto expect = [](const std::string& faults, const std::string& part) {
    EXPECT_NE(faults.find(part), std::string::npos) << faults;
    EXPECT_NE(faults.find("yaml:"), std::string::npos) << "a line: " << faults;
  };
  expect(fault_of("", "open"), "permeable");
  expect(fault_of("", "impermeable"), "did you mean 'impervious'?");
  expect(fault_of("", "leaky"), "resistance");
  expect(fault_of("", "permeable, resistance: 1 d"), "write 'water: leaky' too");
  const std::string sea =
      "    - {name: sea, until: 2 d, count: 1, boundary: [{on: PLACE, free_water: 6 m}]}\n";
  const auto on = [&](const std::string& place) {
    return std::string(sea).replace(sea.find("PLACE"), 5, place);
  };
  expect(fault_of(on("floor")), "'floor' presses on nothing, as ground lies all along it");
  expect(fault_of(on("sheet")), "'sheet' presses on nothing");
  expect(fault_of(on("sheet_top")), "free water needs a boundary");
  std::string dry = pit("");
  dry.erase(dry.find("water: {perm"), dry.find("interfaces:") - dry.find("water: {perm"));
  expect(polargrain::testing::faults_of(dry), "interface 'skin': water: the case has no water");
  std::string edge = cantilever("");
  edge.replace(edge.find("friction: 0 deg"), 15, "friction: 0 deg, water: permeable");
  expect(polargrain::testing::faults_of(edge), "ground lies on one side alone");
}

}  // namespace
