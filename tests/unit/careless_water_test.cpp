// SPDX-License-Identifier: GPL-2.0-or-later
// Scenes of ground and water with one thing wrong each, and odd ones that are right.
#include "app/picture/case_picture.hpp"
#include "app/picture/symbols.hpp"
#include "app/remarks/scene.hpp"
#include "coupler/case/document_kind.hpp"
#include "tests/support/careless_features.hpp"

namespace polargrain::testing {
namespace {

using app::Rank;

/// Half of a strip footing 2 m wide, its edge in the middle of the surface.
const std::string kWet = R"(title: Clay between two curtains under a load
continuum: cauchy
mesh: {rectangle: {size: [4 m, 2 m], elements: [8, 4], regions: {right: [2 m, 0, 4 m, 2 m]}, lines: {line: [2 m, 0, 2 m, 2 m]}}}
materials: {clay: {model: elastic, E: 10 MPa, nu: 0.25}}
regions: {right: clay, rest: clay}
water: {permeability: 1e-8 m/s}
interfaces: {curtain: {on: line, friction: 30 deg, cohesion: 1 GPa, tension: 1 GPa, water: leaky, resistance: 1e8 s}}
boundary:
  - {on: [left, right], fix: [u1]}
  - {on: bottom, fix: [u1, u2]}
  - {on: top, pressure: [[0 d, 0], [9 d, 20 kPa]]}
  - {on: left, drained: true}
  - {on: right, flux: 0 m/s}
steps: {duration: 9 d, count: 90, tolerance: 1e-8}
monitors: {settled: {on: top, displacement: u2}}
output: {table: [settled]}
)";

const std::string kSea = R"(title: Ground below the sea
continuum: cauchy
mesh: {rectangle: {size: [4 m, 4 m], elements: [4, 4]}}
materials: {clay: {model: elastic, E: 10 MPa, nu: 0.25}}
regions: {all: clay}
water: {permeability: 1e-8 m/s, level: 10 m, unit_weight: 10 kN/m3}
boundary:
  - {on: [left, right], fix: [u1]}
  - {on: bottom, fix: [u1, u2]}
  - {on: top, free_water: 10 m}
body: [{unit_weight: 20 kN/m3}]
initial_stress: [{surface: 4 m, unit_weight: 20 kN/m3, K0: 0.5, surcharge: 60 kPa}]
steps: {duration: 60 d, count: 10, first: 1 h, tolerance: 1e-6}
monitors: {settlement: {on: top, displacement: u2}}
output: {table: [settlement]}
)";

const std::string kFillOnASheet = R"(title: Fill comes on a sheet
continuum: cauchy
mesh: {rectangle: {size: [4 m, 2 m], elements: [4, 4], regions: {fill: [0, 1 m, 4 m, 2 m]}, lines: {seam: [0, 1 m, 4 m, 1 m]}}}
materials: {clay: {model: elastic, E: 10 MPa, nu: 0.25}}
regions: {fill: clay, rest: clay}
interfaces: {sheet: {on: seam, friction: 20 deg}}
boundary:
  - {on: bottom, fix: [u1, u2]}
  - {on: [left, right], fix: [u1]}
body: [{unit_weight: 20 kN/m3}]
initial_stress: [{surface: 1 m, unit_weight: 20 kN/m3, K0: 0.5, region: rest}]
steps: {tolerance: 1e-6, stages: [{name: rest, count: 1}, {name: fill, place: fill, count: 2}]}
monitors: {base: {on: bottom, reaction: u2}}
output: {table: [base]}
)";

const std::string kPit = R"(title: A layer of wet ground is dug away
continuum: cauchy
mesh: {rectangle: {size: [4 m, 4 m], elements: [4, 4], regions: {layer: [0, 3 m, 4 m, 4 m]}, lines: {floor: [0, 3 m, 4 m, 3 m]}}}
materials: {clay: {model: elastic, E: 10 MPa, nu: 0.25}}
regions: {layer: clay, rest: clay}
water: {permeability: 1e-8 m/s, level: 4 m, unit_weight: 10 kN/m3}
boundary:
  - {on: [left, right], fix: [u1]}
  - {on: bottom, fix: [u1, u2]}
  - {on: top, drained: true}
body: [{unit_weight: 20 kN/m3}]
initial_stress: [{surface: 4 m, unit_weight: 20 kN/m3, K0: 0.5}]
steps:
  tolerance: 1e-6
  stages:
    - {name: dig, remove: layer, until: 1 d, count: 10, boundary: [{on: floor, water_level: 3 m}]}
    - {name: wait, until: 90 d, count: 10}
monitors: {heave: {on: bottom, reaction: u2}}
output: {table: [heave]}
)";

/// A surcharge that the ground has carried always; then the water below sinks.
const std::string kCarried = R"(title: The water sinks below an old surcharge
continuum: cauchy
mesh: {rectangle: {size: [1 m, 4 m], elements: [1, 8]}}
materials: {clay: {model: elastic, E: 10 MPa, nu: 0.25}}
regions: {all: clay}
water: {permeability: 1e-9 m/s, level: 4 m}
boundary:
  - {on: [left, right], fix: [u1]}
  - {on: bottom, fix: [u1, u2], water_level: [[0 s, 4 m], [10 d, 3.5 m]]}
  - {on: top, drained: true, pressure: 10 kPa}
body: [{unit_weight: 20 kN/m3}]
initial_stress: [{surface: 4 m, unit_weight: 20 kN/m3, K0: 0.5, surcharge: 10 kPa}]
steps: {duration: 100 d, count: 20, first: 1 h, tolerance: 1e-8}
monitors: {u: {on: top, displacement: u2}}
output: {table: [u]}
)";

/// Pressures are those in excess, weights submerged ones.
const std::string kSubmerged = replaced(
    replaced(replaced(kCarried, ", level: 4 m", ""), ", water_level: [[0 s, 4 m], [10 d, 3.5 m]]", ""),
    "[{unit_weight: 20 kN/m3}]\ninitial_stress: [{surface: 4 m, unit_weight: 20",
    "[{unit_weight: 10 kN/m3}]\ninitial_stress: [{surface: 4 m, unit_weight: 10");

/// A layer whose water leaves upwards alone.
const std::string kClay = R"(title: A column of clay
continuum: cauchy
mesh: {rectangle: {size: [1 m, 10 m], elements: [1, 20]}}
materials: {clay: {model: elastic, E: 10 MPa, nu: 0.25}}
regions: {all: clay}
water: {permeability: 2e-9 m/s}
boundary:
  - {on: [left, right], fix: [u1]}
  - {on: bottom, fix: [u1, u2]}
  - {on: top, drained: true, pressure: [[0 s, 0], [1 h, 100 kPa]]}
steps: {duration: 470 d, count: 30, tolerance: 1e-8}
monitors: {u: {on: top, displacement: u2}}
output: {table: [u]}
)";

/// The same, its load there at once.
const std::string kLoadedClay = replaced(kClay, "[[0 s, 0], [1 h, 100 kPa]]", "100 kPa");

/// Free water stands below the surface, and the water in the ground as high.
const std::string kDryBed =
    replaced(replaced(kSea, "level: 10 m", "level: 3 m"), "free_water: 10 m}", "free_water: 3 m}");

/// The sea behind a rigid wall.
const std::string kQuay = replaced(kSea, "boundary:\n  - {on: [left, right], fix: [u1]}",
                                   "interfaces: {quay: {on: left, friction: 20 deg}}\nboundary:\n"
                                   "  - {on: right, fix: [u1]}\n  - {on: quay, fix: [u1, u2]}");

INSTANTIATE_TEST_SUITE_P(
    Water, CarelessFeatures,
    ::testing::Values(
        Careless{"AFloorThatIsClosed", kPit, ", boundary: [{on: floor, water_level: 3 m}]", "",
                 "stage 'dig' removes the ground at 'top', whose water had a given pressure", Rank::doubtful},
        Careless{"TheSeaBetweenWallAndGround", kQuay, "{on: top, free_water: 10 m}",
                 "{on: [top, left], free_water: 10 m}",
                 "'free_water' at 'left' presses on the ground, between it and 'quay'", Rank::wrong},
        Careless{
            "ABoundOfAFlowThatIsNone",
            replaced(replaced(replaced(kWet, "water: leaky, resistance: 1e8 s", "water: impervious"),
                              "  - {on: right, flux: 0 m/s}\n", ""),
                     "  - {on: left, drained: true}\n", ""),
            "water: {permeability: 1e-8 m/s}",
            "water: {undrained: true, bulk_modulus: 200 MPa, void_ratio: 0.7, pressure_change: 1 kPa, shortest_step: 1 s}",
            "'pressure_change' does nothing: all ground is undrained", Rank::doubtful},
        Careless{"ADrainOfUndrainedGround",
                 replaced(replaced(kWet, "water: leaky, resistance: 1e8 s", "water: impervious"),
                          "  - {on: right, flux: 0 m/s}\n", ""),
                 "water: {permeability: 1e-8 m/s}",
                 "water: {undrained: true, bulk_modulus: 200 MPa, void_ratio: 0.7}",
                 "'drained' at 'left' does nothing: all 4 elements there are undrained", Rank::wrong},
        Careless{"ALeakOfUndrainedGround",
                 replaced(replaced(kWet, "  - {on: left, drained: true}\n", ""),
                          "  - {on: right, flux: 0 m/s}\n", ""),
                 "water: {permeability: 1e-8 m/s}",
                 "water: {undrained: true, bulk_modulus: 200 MPa, void_ratio: 0.7}",
                 "interface 'curtain': it leaks with a resistance of 1e+08 s, and all ground is undrained",
                 Rank::doubtful},
        Careless{"TheSeaIsNotInTheStress", kSea, ", surcharge: 60 kPa", "",
                 "water stands 6 m above the surface and weighs 60 kPa, and the surcharge is 0 kPa",
                 Rank::wrong},
        Careless{"TheSeaOfOrdinaryWeightIsNotInTheStress",
                 replaced(kSea, ", unit_weight: 10 kN/m3}\n", "}\n"), ", surcharge: 60 kPa", "",
                 "water stands 6 m above the surface and weighs 58.86 kPa, and the surcharge is 0 kPa",
                 Rank::wrong},
        Careless{"ASurchargeIsNotInTheStress", kCarried, ", surcharge: 10 kPa", "",
                 "behind the sudden load the pressure overshoots", Rank::doubtful},
        Careless{"ASurchargeIsLessThanTheLoad", kCarried, "pressure: 10 kPa", "pressure: 20 kPa",
                 "behind the sudden load the pressure overshoots", Rank::doubtful},
        Careless{"SubmergedWeightBelowALevel",
                 replaced(kCarried, "body: [{unit_weight: 20", "body: [{unit_weight: 10.5"),
                 "4 m, unit_weight: 20", "4 m, unit_weight: 10.5",
                 "region 'all' weighs 10.5 kN/m3 below the 'level' of the water", Rank::doubtful},
        Careless{"SaturatedWeightWithoutALevel",
                 replaced(kSubmerged, "4 m, unit_weight: 10", "4 m, unit_weight: 20"),
                 "body: [{unit_weight: 10", "body: [{unit_weight: 20", "the weight must be the submerged one",
                 Rank::doubtful},
        // Effective: 20 - 10 kN/m3 given, 16 - 10 kN/m3 weigh.
        Careless{"LighterGroundBelowWaterThanItsStress", kSea, "body: [{unit_weight: 20",
                 "body: [{unit_weight: 16",
                 "region 'all' has 16 kN/m3 below body: below water its effective stress changes by -40 %",
                 Rank::wrong},
        Careless{"SubmergedStressBelowALevel", kSea, "4 m, unit_weight: 20", "4 m, unit_weight: 10",
                 "a unit weight of 10 kN/m3, and region 'all' has 20 kN/m3 below body", Rank::wrong},
        Careless{"OneLayerOfAPitIsLighter", kPit, "body: [{unit_weight: 20 kN/m3}]",
                 "body: [{unit_weight: 18 kN/m3, region: layer}, {unit_weight: 20 kN/m3, region: rest}]",
                 "region 'layer' has 18 kN/m3 below body: below water its effective stress changes by -20 %",
                 Rank::doubtful},
        // cv = 2.4465e-6 m2/s. Mean pressures behind the first step: 0.459 of the load, by the series 0.358.
        Careless{
            "AFewStepsOfAColumn", kLoadedClay, "count: 30", "count: 3",
            "ground 10 m from its drains consolidates in H^2/cv = 4.09e+07 s: mean pressures are off by some 10 %",
            Rank::doubtful},
        Careless{
            "ALoadWithinALongStep", kClay, "count: 30", "count: 3",
            "ground 10 m from its drains consolidates in H^2/cv = 4.09e+07 s: mean pressures are off by some 10 %",
            Rank::doubtful},
        Careless{"DaysWithoutTheirUnit", kWet, "[[0 d, 0], [9 d, 20 kPa]]", "[[0, 0], [9, 20 kPa]]",
                 "at time '9', which has no unit and is 9 s; the run takes 9 d", Rank::doubtful},
        Careless{"AFluxIntoADrain", kWet, "{on: right, flux: 0 m/s}", "{on: left, flux: 1e-9 m/s}",
                 "the flux into 'left' changes nothing: all of its 9 nodes have a given pressure",
                 Rank::wrong},
        Careless{
            "ALeakWhoseFrontIsBare", kWet, "steps: {duration: 9 d, count: 90, tolerance: 1e-8}",
            "steps: {tolerance: 1e-8, stages: [{name: load, until: 1 d, count: 10}, {name: dig, remove: right, until: 9 d, "
            "count: 80}]}",
            "4 of its faces have ground on one side alone in stage 'dig': there it is closed",
            Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Water, OddFeatures,
    ::testing::Values(
        Careless{"DugAndDrained", kPit, "", ""}, Careless{"TheSeaAtAQuay", kQuay, "", ""},
        Careless{"FillOnASheet", kFillOnASheet, "", ""}, Careless{"AnOldSurcharge", kCarried, "", ""},
        Careless{"ManyStepsOfAColumn", kLoadedClay, "", ""},
        Careless{"ALoadThatComesSlowly", kClay, "[1 h, 100 kPa]]}\nsteps: {duration: 470 d, count: 30",
                 "[450 d, 100 kPa]]}\nsteps: {duration: 470 d, count: 3"},
        Careless{"WaterBelowABed", replaced(kDryBed, ", surcharge: 60 kPa", ""), "", ""},
        Careless{"SubmergedWeightsWithoutALevel", kSubmerged, "", ""}, Careless{"BelowTheSea", kSea, "", ""}),
    [](const auto& info) { return info.param.name; });

// The level is 1 m above the ground: nine nodes of the top are pressed, some 34 units of the drawing or more apart.
TEST(Picture, ShowsFreeWater) {
  const Scratch scratch("careless_picture");
  const std::string closed = replaced(kWet, "  - {on: left, drained: true}\n", "");
  write(scratch.path() / "case.yaml", replaced(replaced(closed, "water: {permeability: 1e-8 m/s}",
                                                        "water: {permeability: 1e-8 m/s, level: 3 m}"),
                                               "{on: top, pressure: [[0 d, 0], [9 d, 20 kPa]]}",
                                               "{on: top, free_water: [[0 d, 3 m], [9 d, 4 m]]}"));
  const coupler::Case the_case = coupler::read_case(scratch.path() / "case.yaml");
  const coupler::Entry document =
      coupler::load_document_of(coupler::DocumentKind::problem, the_case.file, {});
  const app::PackingsAtRest packings;
  const std::string page = app::case_picture(app::Scene(the_case, document, packings), {});
  EXPECT_NE(page.find("free water to 3 m"), std::string::npos);
  EXPECT_NE(page.find("free water to 4 m"), std::string::npos);
  std::size_t signs = 0;
  for (std::size_t at = page.find(app::kWater); at != std::string::npos; at = page.find(app::kWater, at + 1))
    ++signs;
  EXPECT_GE(signs, 11U);
}

}  // namespace
}  // namespace polargrain::testing
