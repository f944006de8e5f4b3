// SPDX-License-Identifier: GPL-2.0-or-later
// Scenes with one thing wrong each, and odd ones that are right: interfaces, beams, anchors, stages, bodies in space, real time.
#include <fmt/format.h>

#include <cmath>

#include "app/picture/case_picture.hpp"
#include "app/picture/symbols.hpp"
#include "app/remarks/scene.hpp"
#include "coupler/case/document_kind.hpp"
#include "tests/support/careless_scenes.hpp"

namespace polargrain::testing {
namespace {

using app::Rank;

/// A rough wall that yields: Eoed of the sand is 24 MPa, its elements are 1 m wide.
const std::string kWall = R"(title: A rough wall is drawn away from sand
continuum: cauchy
mesh: {rectangle: {size: [8 m, 4 m], elements: [8, 4]}}
materials:
  sand: {model: elastoplastic, E: 20 MPa, nu: 0.25, friction_angle: 30 deg, dilatancy_angle: 10 deg, cohesion: 0.1 kPa}
regions: {all: sand}
interfaces:
  wall: {on: left, friction: 20 deg, normal_stiffness: 1 GPa/m, shear_stiffness: 100 MPa/m}
boundary:
  - {on: bottom, fix: [u1, u2]}
  - {on: right, fix: [u1]}
  - {on: wall, fix: [u2], move: {u1: -20 mm}}
  - {on: top, pressure: 10 kPa}
body: [{unit_weight: 18 kN/m3}]
initial_stress: [{surface: 4 m, unit_weight: 18 kN/m3, K0: 0.5, surcharge: 10 kPa}]
steps: {count: 20, tolerance: 1e-5}
monitors: {pressure: {interface: wall, value: pressure}}
output: {table: [pressure]}
)";

const std::string kSheet = R"(title: A sheet pile, held by an anchor
continuum: cauchy
mesh: {rectangle: {size: [8 m, 4 m], elements: [8, 4]}}
materials: {sand: {model: elastic, E: 20 MPa, nu: 0.25}}
regions: {all: sand}
interfaces: {skin: {on: left, friction: 20 deg}}
beams: {sheet: {on: left, EA: 3000 MN/m, EI: 20 MNm2/m, Mp: 300 kNm/m}}
anchors: {rod: {from: sheet_top, to: [-10 m, 4 m], EA: 100 MN, spacing: 2 m}}
boundary:
  - {on: bottom, fix: [u1, u2]}
  - {on: right, fix: [u1]}
  - {on: sheet_bottom, fix: [u1, u2]}
  - {on: top, pressure: [[0, 10 kPa], [1, 40 kPa]]}
body: [{unit_weight: 18 kN/m3}]
initial_stress: [{surface: 4 m, unit_weight: 18 kN/m3, K0: 0.5, surcharge: 10 kPa}]
steps: {count: 5, tolerance: 1e-6}
monitors: {rod: {anchor: rod}}
output: {table: [rod]}
)";

const std::string kBank = R"(title: A bank comes, then traffic on it
continuum: cauchy
mesh:
  rectangle:
    size: [20 m, 12 m]
    elements: [10, 6]
    regions: {bank: [10 m, 10 m, 20 m, 12 m], void: [0, 10 m, 10 m, 12 m]}
materials:
  soil: {model: elastic, E: 40 MPa, nu: 0.3}
regions: {bank: soil, rest: soil}
boundary:
  - {on: bottom, fix: [u1, u2]}
  - {on: [left, right], fix: [u1]}
body: [{unit_weight: 18 kN/m3}]
initial_stress: [{surface: 10 m, unit_weight: 18 kN/m3, K0: 0.5, region: rest}]
steps:
  stages:
    - {name: start, count: 1}
    - {name: bank, place: bank, count: 2}
    - {name: traffic, count: 2, boundary: [{on: top, pressure: 10 kPa}]}
monitors: {base: {on: bottom, reaction: u2}}
output: {table: [base]}
)";

const std::string kColumn = R"(title: A column shaken at its base
continuum: cauchy
mesh: {rectangle: {size: [1 m, 10 m], elements: [1, 20]}}
materials:
  soil: {model: elastic, E: 40 MPa, nu: 0.3, density: 2000 kg/m3}
regions: {all: soil}
boundary:
  - {on: bottom, fix: [u1, u2]}
  - {on: top, traction: {u1: [[0, 10 kPa], [0.1, 10 kPa], [0.11, 0]]}}
  - {on: [left, right], fix: [u2]}
  - {on: left, tie: right}
steps: {method: explicit, time: real, duration: 2 s, count: 200, mass_damping: 3}
monitors:
  top: {on: top, displacement: u1}
output: {every: 50, table: [top]}
)";

const std::string kBlock = R"(title: A block of ground under its weight and a load
continuum: cauchy
mesh: {box: {size: [4 m, 4 m, 2 m], elements: [2, 2, 1]}}
materials:
  soil: {model: elastoplastic, E: 40 MPa, nu: 0.3, friction_angle: 32 deg, dilatancy_angle: 2 deg, cohesion: 15 kPa}
regions: {all: soil}
boundary:
  - {on: bottom, fix: [u1, u2, u3]}
  - {on: [left, right], fix: [u1]}
  - {on: [front, back], fix: [u2]}
  - {on: top, pressure: [[0, 0], [1, 30 kPa]]}
body:
  - {force: [0, 0, -18 kN/m3], factor: [[0, 0], [1, 1]]}
steps: {count: 5, tolerance: 1e-5}
monitors: {base: {on: bottom, reaction: u3}}
output: {table: [base]}
)";

bool is_told_of_features(const app::Remarks& remarks, const std::string& message, Rank rank) {
  return std::ranges::any_of(remarks, [&](const app::Remark& remark) {
    return remark.rank == rank && remark.at.line > 0 && !remark.remedy.empty() &&
           remark.at.message.find(message) != std::string::npos;
  });
}

class CarelessFeatures : public ::testing::TestWithParam<Careless> {};

TEST_P(CarelessFeatures, IsTold) {
  const app::Remarks remarks = remarks_of(GetParam());
  EXPECT_TRUE(is_told_of_features(remarks, GetParam().message, GetParam().rank))
      << app::text_of(remarks, true);
}

/// One more thing that is wrong would be told too: there is just one remark.
TEST_P(CarelessFeatures, IsTheOnlyRemark) {
  const app::Remarks remarks = remarks_of(GetParam());
  EXPECT_EQ(remarks.size(), 1U) << app::text_of(remarks, true);
}

INSTANTIATE_TEST_SUITE_P(
    Structures, CarelessFeatures,
    ::testing::Values(
        Careless{"SoftInterface", kWall, "normal_stiffness: 1 GPa/m", "normal_stiffness: 10 MPa/m",
                 "normal_stiffness of 10 MPa/m is 0.42 of Eoed/h", Rank::doubtful},
        Careless{"InterfaceInKilopascals", kWall, "shear_stiffness: 100 MPa/m", "shear_stiffness: 100 kPa/m",
                 "shear_stiffness of 0.1 MPa/m is 0.0042 of Eoed/h"},
        Careless{"InterfaceStrongerThanGround", kWall, "friction: 20 deg", "friction: 45 deg",
                 "its friction of 45 deg is above the 30 deg of material 'sand' beside it", Rank::doubtful},
        Careless{"BeamAsThickAsAHouse", kSheet, "EI: 20 MNm2/m", "EI: 20000 MNm2/m",
                 "EA and EI belong to a plate 8.94 m thick"},
        Careless{"BeamStifferThanSteel", kSheet, "EI: 20 MNm2/m", "EI: 20 kNm2/m, GA: 100 MN/m",
                 "EA and EI belong to a plate 8.94 mm thick, sqrt(12 EI / EA), of 335 GPa"},
        Careless{"BeamOfFoil", kSheet, "EI: 20 MNm2/m, Mp: 300 kNm/m", "EI: 0.02 kNm2/m",
                 "EA and EI belong to a plate 0.283 mm thick"},
        Careless{"AnchorFixedAtANode", kSheet, "to: [-10 m, 4 m]", "to: [5 m, 2 m]",
                 "its far end (5, 2) m lies within region 'all' and is fixed there", Rank::doubtful},
        Careless{"AnchorFixedInTheGround", kSheet, "to: [-10 m, 4 m]", "to: [5.5 m, 2.5 m]",
                 "its far end (5.5, 2.5) m lies within region 'all' and is fixed there", Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Stages, CarelessFeatures,
    ::testing::Values(Careless{"BankWithoutWeight", kBank, "body: [{unit_weight: 18 kN/m3}]",
                               "body: [{unit_weight: 18 kN/m3, region: rest}]",
                               "region 'bank' comes without a weight, and other ground has 18 kN/m3"},
                      Careless{"TableThatIsOver", kBank, "pressure: 10 kPa",
                               "pressure: [[0, 0], [1, 10 kPa]]",
                               "the table ends at time 1, and stage 'traffic' begins at time 2"}),
    [](const auto& info) { return info.param.name; });

/// The same block, at rest under its weight and a surcharge.
const std::string kBlockAtRest =
    replaced(replaced(kBlock, "pressure: [[0, 0], [1, 30 kPa]]", "pressure: [[0, 10 kPa], [1, 30 kPa]]"),
             "  - {force: [0, 0, -18 kN/m3], factor: [[0, 0], [1, 1]]}\n",
             "  - {unit_weight: 18 kN/m3}\n"
             "initial_stress: [{surface: 2 m, unit_weight: 18 kN/m3, K0: 0.5, surcharge: 10 kPa}]\n");

INSTANTIATE_TEST_SUITE_P(
    InSpaceAsInThePlane, CarelessFeatures,
    ::testing::Values(
        Careless{"SurfaceAboveTheMesh", kBlockAtRest, "surface: 2 m", "surface: 3 m",
                 "the surface is at 3 m, and the highest point of the mesh at 2 m"},
        Careless{"RatioBeyondStrength", kBlockAtRest, "K0: 0.5", "K0: 12", "K0 of 12 is beyond"},
        Careless{"PressureWithoutUnit", kBlock, "[[0, 0], [1, 30 kPa]]", "[[0, 0], [1, 50]]",
                 "'50' has no unit and is 50 Pa"},
        Careless{"AWeightTwice", kBlockAtRest, "  - {unit_weight: 18 kN/m3}\n",
                 "  - {unit_weight: 18 kN/m3}\n  - {unit_weight: 18 kN/m3, region: all}\n",
                 "region 'all' has the same force of 18 kN/m3 twice"},
        Careless{"APressureTwice", kBlock, "body:", "  - {on: top, pressure: [[0, 0], [1, 30 kPa]]}\nbody:",
                 "4 sides carry the same pressure, of up to 30 kPa, twice", Rank::doubtful},
        Careless{"PressureOnAHeldFace", kBlock, "{on: top, pressure", "{on: top, fix: [u3], pressure",
                 "the pressure on 'top' has no effect"},
        Careless{"SoftAsFoam", kBlock, "E: 40 MPa", "E: 400 kPa", "that alone is an elastic strain of 9 %"},
        Careless{"AForceOnEachNode", kBlock, "pressure: [[0, 0], [1, 30 kPa]]",
                 "node_force: {u3: [[0, 0], [1, -1 kN]]}",
                 "each of the 21 nodes of 'top' takes a force of 1 kN: 21 kN", Rank::doubtful},
        Careless{"ReactionOfAFreeFace", kBlock, "base: {on: bottom", "base: {on: top",
                 "u3 is free at all of its nodes"},
        Careless{"CompressionConeInPlaneStrain", kBlock, "{on: [left, right], fix", "{on: left, fix",
                 "both ends along 2 are held: in plane strain this cone has", Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

/// A cylinder between smooth plates.
const std::string kCylinder = R"(title: A cylinder is compressed
continuum: cauchy
mesh: {element: H8, cylinder: {radius: 5 cm, height: 20 cm, elements: [8, 2, 6]}}
materials:
  sand: {model: elastoplastic, E: 40 MPa, nu: 0.3, friction_angle: 32 deg, dilatancy_angle: 2 deg, cohesion: 1 kPa}
regions: {all: sand}
boundary:
  - {on: bottom, fix: [u3]}
  - {on: bottom_axis, fix: [u1, u2]}
  - {on: bottom_side_right, fix: [u2]}
  - {on: top, move: {u3: -4 mm}}
  - {on: side, pressure: 100 kPa}
initial_stress: [{stress: [-100 kPa, -100 kPa, -100 kPa, 0, 0, 0]}]
steps: {count: 20, tolerance: 1e-5}
monitors: {force: {on: top, reaction: u3}}
output: {table: [force]}
)";

INSTANTIATE_TEST_SUITE_P(
    SpaceAndTime, CarelessFeatures,
    ::testing::Values(Careless{"APolygonForACircle", kCylinder, "elements: [8, 2, 6]", "elements: [4, 2, 6]",
                               "is a polygon of 16 sides, 2.6 % smaller than the circle", Rank::doubtful},
                      Careless{"WeightAlongTheSecondAxis", kBlock, "[0, 0, -18 kN/m3]", "[0, -18 kN/m3, 0]",
                               "and 3 points up: nothing pulls the body down"},
                      Careless{"WeightOfADensity", kBlock, "-18 kN/m3]", "-1800]", "a weight of 1.8 kN/m3"},
                      Careless{"PoissonInSpace", kBlock, "nu: 0.3", "nu: 0.03", "nu is 0.03", Rank::doubtful},
                      Careless{"DensityInTons", kColumn, "density: 2000 kg/m3", "density: 2.0",
                               "a density of 2 kg/m3"}),
    [](const auto& info) { return info.param.name; });

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

const std::string kFooting = R"(title: A strip footing on clay
continuum: cauchy
mesh: {rectangle: {size: [4 m, 2 m], elements: [16, 8], lines: {footing: [0, 2 m, 1 m, 2 m], apron: [1 m, 2 m, 4 m, 2 m]}}}
materials:
  clay: {model: elastoplastic, E: 10 MPa, nu: 0.45, friction_angle: 0 deg, dilatancy_angle: 0 deg, cohesion: 20 kPa}
regions: {all: clay}
boundary:
  - {on: bottom, fix: [u1, u2]}
  - {on: [left, right], fix: [u1]}
  - {on: footing, move: {u2: -40 mm}}
  - {on: apron, pressure: 10 kPa}
initial_stress: [{stress: [-10 kPa, -10 kPa, -10 kPa, 0]}]
steps: {count: 20, tolerance: 1e-5}
monitors: {force: {on: footing, reaction: u2}}
)";

INSTANTIATE_TEST_SUITE_P(
    Plates, CarelessFeatures,
    ::testing::Values(
        Careless{"FootingOnTwoElements", kFooting, "elements: [16, 8]", "elements: [8, 4]",
                 "'footing' is moved and measures 2 elements: where it ends the stress has no bound, and the "
                 "load of failure is up to 8 % too high",
                 Rank::doubtful},
        Careless{"FootingWithTwoEnds",
                 replaced(kFooting, "{on: apron, pressure", "{on: [apron, court], pressure"),
                 "footing: [0, 2 m, 1 m, 2 m], apron: [1 m, 2 m, 4 m, 2 m]",
                 "footing: [1 m, 2 m, 2 m, 2 m], apron: [2 m, 2 m, 4 m, 2 m], court: [0, 2 m, 1 m, 2 m]",
                 "measures 4 elements", Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

const std::string kReadAlong = "monitors: {base: {on: bottom, reaction: u2}}\n";

INSTANTIATE_TEST_SUITE_P(
    Profiles, CarelessFeatures,
    ::testing::Values(
        Careless{"FromInMillimetres", kBank, kReadAlong,
                 kReadAlong + "profiles: {axis: {from: [4, 0], to: [4, 120], values: [s22]}}\n",
                 "profile 'axis': it ends outside of the body: 46 of its 51 points have no values",
                 Rank::doubtful},
        Careless{"DownwardsFromTheSurface", kBank, kReadAlong,
                 kReadAlong + "profiles: {axis: {from: [4 m, 0], to: [4 m, -10 m], values: [u2]}}\n",
                 "50 of its 51 points have no values", Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

class OddFeatures : public ::testing::TestWithParam<Careless> {};

TEST_P(OddFeatures, StayWithoutARemark) {
  const app::Remarks remarks = remarks_of(GetParam());
  EXPECT_TRUE(remarks.empty()) << app::text_of(remarks, true);
}

INSTANTIATE_TEST_SUITE_P(
    All, OddFeatures,
    ::testing::Values(
        Careless{"Wall", kWall, "", ""}, Careless{"Sheet", kSheet, "", ""}, Careless{"Bank", kBank, "", ""},
        Careless{"Block", kBlock, "", ""}, Careless{"FreeVibration", kColumn, "", ""},
        Careless{"SmoothInterface", kWall,
                 "friction: 20 deg, normal_stiffness: 1 GPa/m, shear_stiffness: 100 MPa/m", "friction: 0"},
        Careless{"InterfaceAsRoughAsTheGround", kWall, "friction: 20 deg", "friction: 30 deg"},
        Careless{"ARopeToAnEndBeyondTheMesh", kSheet, "spacing: 2 m",
                 "spacing: 2 m, compressive_strength: 0, prestress: 10 kN"},
        Careless{"AnAnchorToTheOtherSide", kSheet, "to: [-10 m, 4 m]", "to: [8 m, 2 m]"},
        Careless{"AThinSheet", kSheet, "EA: 3000 MN/m, EI: 20 MNm2/m, Mp: 300 kNm/m",
                 "EA: 2100 MN/m, EI: 17.5 kNm2/m, GA: 800 MN/m"},
        Careless{"BankWithAStressOfItsOwn", kBank, "K0: 0.5, region: rest}]",
                 "K0: 0.5, region: rest}, {surface: 12 m, unit_weight: 18 kN/m3, K0: 0.5, region: bank}]"},
        Careless{"DugAndDrained", kPit, "", ""}, Careless{"TheSeaAtAQuay", kQuay, "", ""},
        Careless{"ABlockAtRest", kBlockAtRest, "", ""},
        Careless{
            "ALoadOfAStage", replaced(kBlockAtRest, "[[0, 10 kPa], [1, 30 kPa]]", "10 kPa"),
            "steps: {count: 5, tolerance: 1e-5}",
            "steps: {tolerance: 1e-5, stages: [{name: rest, count: 1}, {name: load, count: 2, boundary: [{on: top, "
            "pressure: 20 kPa}]}]}"},
        Careless{"PlaneStrainThatIsSaid", replaced(kBlock, "{on: [left, right], fix", "{on: left, fix"),
                 "dilatancy_angle: 2 deg", "dilatancy_angle: 2 deg, match: plane_strain"},
        Careless{"ARoundCylinder", kCylinder, "", ""},
        Careless{"ACurvedCylinder", kCylinder,
                 "H8, cylinder: {radius: 5 cm, height: 20 cm, elements: [8, 2, 6]}",
                 "H20R, cylinder: {radius: 5 cm, height: 20 cm, elements: [2, 1, 4]}"},
        Careless{"FillOnASheet", kFillOnASheet, "", ""}, Careless{"BelowTheSea", kSea, "", ""},
        Careless{"AFooting", kFooting, "", ""},
        Careless{"ALineAcrossAHole", kBank, kReadAlong,
                 kReadAlong + "profiles: {slope: {from: [2 m, 9 m], to: [12 m, 12 m], values: [u2]}}\n"},
        Careless{"TrafficThatGoesAgain", kBank, "pressure: 10 kPa",
                 "pressure: [[2, 0], [2.5, 10 kPa], [3, 0]]"},
        Careless{"ShakenSideways", kBlock, "force: [0, 0, -18 kN/m3]", "force: [3 kN/m3, 0, -18 kN/m3]"}),
    [](const auto& info) { return info.param.name; });

/// Slips that are spread over twice an element; the strength falls from 42 to 30 degrees.
const std::string kSpread = R"(title: Compression of a sand whose slips are spread
continuum: {kind: cauchy, spread: 50 mm}
mesh: {rectangle: {size: [0.2 m, 0.4 m], elements: [8, 16]}}
materials:
  sand: {model: elastoplastic, E: 30 MPa, nu: 0.3, confining: 100 kPa, friction_angle: [42 deg, 30 deg], dilatancy_angle: 10 deg, cohesion: 0.1 kPa}
regions: {all: sand}
boundary:
  - {on: bottom, fix: [u2]}
  - {on: bottom_left, fix: [u1]}
  - {on: top, fix: [u1], move: {u2: -16 mm}}
  - {on: [left, right], pressure: 100 kPa}
steps: {count: 40}
monitors: {top_force: {on: top, reaction: u2}}
)";

INSTANTIATE_TEST_SUITE_P(
    SpreadSlips, CarelessFeatures,
    ::testing::Values(
        Careless{"SpreadBelowTwoElements", kSpread, "spread: 50 mm", "spread: 40 mm",
                 "the elements of region 'all' measure 25 mm, 0.625 times the spread (at most 0.5)",
                 Rank::doubtful},
        Careless{"SpreadInMicrometres", kSpread, "spread: 50 mm", "spread: 50 um", "500 times the spread",
                 Rank::doubtful},
        Careless{"SpreadWithoutUnit", kSpread, "spread: 50 mm", "spread: 50",
                 "spread is 5e+04 mm, 125 times the larger side of the body (400 mm; at most 0.5)",
                 Rank::wrong},
        Careless{"SpreadInCentimetres", kSpread, "spread: 50 mm", "spread: 300 mm",
                 "0.75 times the larger side of the body", Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(SpreadSlips, OddFeatures,
                         ::testing::Values(Careless{"OverTwoElements", kSpread, "", ""},
                                           Careless{"NothingSoftens", kSpread, "[42 deg, 30 deg]", "42 deg"},
                                           Careless{"ColumnOfOneRow",
                                                    replaced(kSpread, "[0.2 m, 0.4 m], elements: [8, 16]",
                                                             "[10 mm, 0.4 m], elements: [1, 40]"),
                                                    "-16 mm", "-0.9 mm"}),
                         [](const auto& info) { return info.param.name; });

/// On 2 s of the column on a base that moves after quake.csv.
app::Remarks remarks_on_motion_of(const Scratch& scratch) {
  write(scratch.path() / "case.yaml",
        replaced(replaced(kColumn, "  - {on: bottom, fix: [u1, u2]}\n",
                          "  - {on: bottom, fix: [u2], accelerate: {u1: quake.csv}}\n"),
                 "  - {on: top, traction: {u1: [[0, 10 kPa], [0.1, 10 kPa], [0.11, 0]]}}\n", ""));
  return app::remarks_on(coupler::read_case(scratch.path() / "case.yaml"), std::vector<std::string>{}, {});
}

/// A motion of `rows` rows 0.01 s apart, of this amplitude in m/s2. @returns the remarks on 2 s of it
app::Remarks remarks_on_motion(int rows, double amplitude) {
  const Scratch scratch("careless_motion");
  std::string table = "time,acceleration\n";
  for (int row = 0; row < rows; ++row)
    table += fmt::format("{},{}\n", 0.01 * row, amplitude * std::sin(0.12 * row));
  write(scratch.path() / "quake.csv", table);
  return remarks_on_motion_of(scratch);
}

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

TEST(StartFrom, AnotherContinuumOrALargerBodyIsTold) {
  const Scratch scratch("careless_start");
  write(scratch.path() / "case.yaml", kBank);
  coupler::Case the_case = coupler::read_case(scratch.path() / "case.yaml");
  the_case.start_from = scratch.path() / "first";
  coupler::RunBefore before{"first", fem::Continuum::cosserat, {0.0, 0.0}, {20.0, 12.0}};
  const auto told = [&](const std::string& message) {
    the_case.run_before = before;
    const app::Remarks remarks = app::remarks_on(the_case, std::vector<std::string>{}, {});
    return is_told_of_features(remarks, message, Rank::doubtful);
  };
  EXPECT_FALSE(told("measures"));
  before.largest = {25.0, 12.0};
  EXPECT_TRUE(told("the body in 'first' measures 25 m along 1, this one 20 m"));
  the_case.problem.continuum = fem::Continuum::cauchy;
  EXPECT_TRUE(told("'first' has micro-rotations and couple stresses"));
  before.continuum = fem::Continuum::cauchy;
  EXPECT_FALSE(told("couple stresses"));
  the_case.problem.continuum = fem::Continuum::cosserat;
  EXPECT_TRUE(told("'first' is of the classical continuum"));
}

TEST(RealTime, NeedsExplicitSteps) {
  const Scratch scratch("careless_method");
  for (const char* const method : {"", "method: newton, ", "method: automatic, "}) {
    write(scratch.path() / "case.yaml", replaced(kColumn, "method: explicit, ", method));
    try {
      (void)coupler::read_case(scratch.path() / "case.yaml");
      ADD_FAILURE() << method;
    } catch (const InputError& error) {
      EXPECT_EQ(error.faults().front().line, 12);
      EXPECT_EQ(error.faults().front().message,
                "steps: time: real time has explicit steps alone; write 'method: explicit'");
    }
  }
}

TEST(QuietBoundary, MovesThoughItIsFixedAtTheStart) {
  const Scratch scratch("careless_quiet");
  write(scratch.path() / "case.yaml",
        replaced(replaced(kColumn, "{on: bottom, fix: [u1, u2]}", "{on: bottom, fix: [u1, u2], quiet: true}"),
                 "monitors:\n", "monitors:\n  base: {on: bottom, displacement: u1}\n"));
  const app::Remarks remarks =
      app::remarks_on(coupler::read_case(scratch.path() / "case.yaml"), std::vector<std::string>{}, {});
  EXPECT_TRUE(remarks.empty()) << app::text_of(remarks, true);
}

TEST(Motions, ThatGoOnBehindTheRunAreTold) {
  const app::Remarks remarks = remarks_on_motion(501, 1.0);
  EXPECT_TRUE(is_told_of_features(remarks, "the motion of 'quake.csv' lasts 5 s, and the run ends at 2 s",
                                  Rank::wrong))
      << app::text_of(remarks, true);
}

TEST(Motions, InCentimetresAreTold) {
  const app::Remarks remarks = remarks_on_motion(201, 100.0);
  EXPECT_TRUE(is_told_of_features(remarks, "m/s2, 10 times gravity", Rank::wrong))
      << app::text_of(remarks, true);
}

/// Every second row has another sign: 50 Hz. Shear waves of sqrt(15.4 MPa / 2000 kg/m3) = 87.7 m/s are 1.75 m long then, and
/// elements have 0.707 m.
TEST(Motions, TooFastForTheElementsAreTold) {
  const Scratch scratch("careless_noise");
  std::string table = "time,acceleration\n";
  for (int row = 0; row <= 200; ++row) table += fmt::format("{},{}\n", 0.01 * row, row % 2 == 0 ? 1.0 : -1.0);
  write(scratch.path() / "quake.csv", table);
  const app::Remarks remarks = remarks_on_motion_of(scratch);
  EXPECT_TRUE(is_told_of_features(
      remarks, "has 50 Hz in the mean, whose shear wave is 1.75 m long in region 'all': 2.5 elements",
      Rank::doubtful))
      << app::text_of(remarks, true);
}

TEST(Motions, AsLongAsTheRunAreRight) {
  const app::Remarks remarks = remarks_on_motion(201, 1.0);
  EXPECT_TRUE(remarks.empty()) << app::text_of(remarks, true);
}

}  // namespace
}  // namespace polargrain::testing
