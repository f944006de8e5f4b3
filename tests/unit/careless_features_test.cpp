// SPDX-License-Identifier: GPL-2.0-or-later
// Scenes with one thing wrong each, and odd ones that are right: interfaces, beams, anchors, stages, profiles, spread slips.
#include "tests/support/careless_features.hpp"

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
    ::testing::Values(
        Careless{"BankWithoutWeight", kBank, "body: [{unit_weight: 18 kN/m3}]",
                 "body: [{unit_weight: 18 kN/m3, region: rest}]",
                 "region 'bank' comes without a weight, and other ground has 18 kN/m3"},
        Careless{"PressureOfAStageWithoutUnit", kBank, "pressure: 10 kPa}", "pressure: 10}",
                 "'10' has no unit and is 10 Pa"},
        Careless{"ForcesOfAStageOnNodes", kBank, "pressure: 10 kPa}", "node_force: {u2: -1 kN/m}}",
                 "nodes of 'top' takes a force of 1 kN/m", Rank::doubtful},
        Careless{"PressureOfAStageOnAHeldSide", kBank, "{on: top, pressure: 10 kPa}",
                 "{on: right, pressure: 10 kPa}", "the pressure on 'right' has no effect"},
        Careless{"PressureOfAStageTwice", kBank, "[{on: top, pressure: 10 kPa}]",
                 "[{on: top, pressure: 10 kPa}, {on: top, pressure: 10 kPa}]",
                 "carry the same pressure, of up to 10 kPa, twice", Rank::doubtful},
        Careless{"WeightOfAPartBesideThatOfAll", kBank, "body: [{unit_weight: 18 kN/m3}]",
                 "body: [{unit_weight: 18 kN/m3}, {unit_weight: 20 kN/m3, region: bank}]",
                 "region 'bank' has 18 and 20 kN/m3, of two items: 38 kN/m3 together", Rank::doubtful},
        // K0 of 0.5: (1 + 0.5) / 2 of 18 kN/m3 over half of 2 m.
        Careless{"BankWithTheStressOfItsMaterial", kBank, "E: 40 MPa, nu: 0.3}\nregions: {bank: soil",
                 "E: 40 MPa, nu: 0.3}\n  fill: {model: elastic, E: 40 MPa, nu: 0.3, confining: 100 "
                 "kPa}\nregions: {bank: fill",
                 "region 'bank', which a stage places, comes with the 100 kPa of its 'confining'; 18 "
                 "kN/m3 over its 2 m make 13.5 kPa in its middle"},
        Careless{"WeightOfAPartThatComesBesideThatOfAll", kBank, "place: bank, count: 2}",
                 "place: bank, count: 2, body: [{unit_weight: 20 kN/m3, region: bank}]}",
                 "region 'bank' has 18 and 20 kN/m3, of two items: 38 kN/m3 together", Rank::doubtful},
        Careless{"TableThatIsOver", kBank, "pressure: 10 kPa", "pressure: [[0, 0], [1, 10 kPa]]",
                 "the table ends at time 1, and stage 'traffic' begins at time 2"}),
    [](const auto& info) { return info.param.name; });

const std::string kJoint = R"(title: Two blocks with a joint between them
continuum: cauchy
mesh: {rectangle: {size: [2 m, 2 m], elements: [4, 4], lines: {joint: [1 m, 0, 1 m, 2 m]}}}
materials: {rock: {model: elastic, E: 20 MPa, nu: 0.2}}
regions: {all: rock}
interfaces: {slide: {on: joint, friction: 10 deg}}
boundary:
  - {on: left, fix: [u1, u2]}
  - {on: right, move: {u1: -1 mm, u2: -20 mm}}
steps: {count: 4, tolerance: 1e-8}
monitors: {slip: {interface: slide, value: slip}}
)";

const std::string kWetJoint = R"(title: Water through a joint between two layers
continuum: cauchy
mesh: {rectangle: {size: [1 m, 4 m], elements: [1, 8], lines: {joint: [0, 2 m, 1 m, 2 m]}}}
materials: {soil: {model: elastic, E: 20 MPa, nu: 0.3}}
regions: {all: soil}
water: {unit_weight: 10 kN/m3, level: 4 m, permeability: 1e-6 m/s}
interfaces: {slide: {on: joint, friction: 30 deg, water: permeable}}
boundary:
  - {on: [left, right], fix: [u1]}
  - {on: bottom, fix: [u1, u2], water_level: [[0, 4 m], [10 d, 7 m]]}
  - {on: top, drained: true}
body: [{unit_weight: 20 kN/m3}]
initial_stress: [{surface: 4 m, unit_weight: 20 kN/m3, K0: 0.5}]
steps: {duration: 1000 d, count: 4, tolerance: 1e-8}
monitors: {pressure: {on: joint, water: pressure}}
)";

INSTANTIATE_TEST_SUITE_P(
    Joints, CarelessFeatures,
    ::testing::Values(
        Careless{
            "OneSideOfAJoint", kJoint, "{interface: slide, value: slip}", "{on: joint, displacement: u2}",
            "the interface 'slide' parts 'joint', and these are the nodes of one side alone", Rank::doubtful},
        Careless{"PorePressureOfOneSideOfAJoint", kWetJoint, "water: permeable}",
                 "water: leaky, resistance: 1e6 s}",
                 "the interface 'slide' parts 'joint', and these are the nodes of one side alone",
                 Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

const std::string kLayers = R"(title: Two layers at rest, then a load
continuum: cauchy
mesh: {rectangle: {size: [10 m, 12 m], elements: [5, 12], regions: {fill: [0, 10 m, 10 m, 12 m]}}}
materials: {soil: {model: elastic, E: 40 MPa, nu: 0.3}}
regions: {fill: soil, rest: soil}
boundary:
  - {on: [left, right], fix: [u1]}
  - {on: bottom, fix: [u1, u2]}
  - {on: top, pressure: [[0, 0 kPa], [1, 20 kPa]]}
body: [{unit_weight: 17 kN/m3, region: fill}, {unit_weight: 20 kN/m3, region: rest}]
initial_stress:
  - {surface: 12 m, unit_weight: 17 kN/m3, K0: 0.5, region: fill}
  - {surface: 10 m, unit_weight: 20 kN/m3, K0: 0.5, surcharge: 34 kPa, region: rest}
steps: {count: 2, tolerance: 1e-8}
monitors: {support: {on: bottom, reaction: u2}}
)";

const std::string kCantilever = R"(title: A cantilever, one element thick
continuum: cauchy
mesh: {rectangle: {size: [4 m, 0.5 m], elements: [8, 1]}, element: Q4R}
materials: {bar: {model: elastic, E: 30 GPa, nu: 0.2}}
regions: {all: bar}
boundary:
  - {on: left, fix: [u1, u2]}
  - {on: right, traction: {u2: [[0, 0 kPa], [1, -100 kPa]]}}
steps: {count: 1, tolerance: 1e-8}
monitors: {force: {on: left, reaction: u2}}
)";

INSTANTIATE_TEST_SUITE_P(
    LayersAndBars, CarelessFeatures,
    ::testing::Values(
        Careless{
            "ALayerWithoutItsSurcharge", kLayers, ", surcharge: 34 kPa", "",
            "at the height 10 m region 'fill' ends with a vertical stress of 34 kPa and region 'rest' below it begins "
            "with 0 kPa"},
        Careless{"OneElementOfOnePointThick", kCantilever, "", "",
                 "elements of one point over the thickness of 0.5 m: 1 (at least 4)", Rank::doubtful},
        Careless{"OneBrickOfOnePointThick", replaced(kCantilever, "fix: [u1, u2]", "fix: [u1, u2, u3]"),
                 "rectangle: {size: [4 m, 0.5 m], elements: [8, 1]}, element: Q4R",
                 "box: {size: [4 m, 0.5 m, 0.5 m], elements: [8, 1, 1]}, element: H8R",
                 "elements of one point over the thickness of 0.5 m: 1 (at least 4)", Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

/// The bar, whole or as a layer on a base, is right in elements of more points, and so is one of more elements.
INSTANTIATE_TEST_SUITE_P(
    LayersAndBars, OddFeatures,
    ::testing::Values(
        Careless{"LayersThatFit", kLayers, "", ""},
        Careless{"ABarOfMorePoints", kCantilever, ", element: Q4R", ""},
        Careless{"ABarOfFourElements", kCantilever, "[8, 1]", "[32, 4]"},
        Careless{"ALayerOfOnePoint",
                 replaced(kCantilever, "{on: left, reaction: u2}", "{on: bottom, reaction: u2}"),
                 "left, fix: [u1, u2]", "bottom, fix: [u1, u2]"},
        Careless{"AnItemOfALayerBeforeThatOfAll", kLayers,
                 "  - {surface: 12 m, unit_weight: 17 kN/m3, K0: 0.5, region: fill}\n"
                 "  - {surface: 10 m, unit_weight: 20 kN/m3, K0: 0.5, surcharge: 34 kPa, region: rest}\n",
                 "  - {surface: 12 m, unit_weight: 17 kN/m3, K0: 0.5, region: fill}\n"
                 "  - {surface: 12 m, unit_weight: 20 kN/m3, K0: 0.5, surcharge: -6 kPa}\n"}),
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

/// A soft layer that two elements hold.
const std::string kLayered = R"(title: A load on layered ground
continuum: cauchy
mesh:
  rectangle:
    size: [4 m, 2 m]
    elements: [16, 8]
    regions: {layer: [0, 1 m, 4 m, 1.5 m], below: [-1 m, -1 m, 9 m, 1 m]}
materials:
  soft: {model: elastic, E: 10 MPa, nu: 0.3}
  firm: {model: elastic, E: 40 MPa, nu: 0.3}
regions: {layer: soft, below: firm, rest: firm}
boundary:
  - {on: bottom, fix: [u1, u2]}
  - {on: [left, right], fix: [u1]}
  - {on: top, pressure: [[0, 0], [1, 20 kPa]]}
steps: {count: 2, tolerance: 1e-6}
monitors: {base: {on: bottom, reaction: u2}}
output: {table: [base]}
)";

INSTANTIATE_TEST_SUITE_P(
    EndsOfRegions, CarelessFeatures,
    ::testing::Values(
        Careless{"AThinnerLayer", kLayered, "1 m, 4 m, 1.5 m]", "1.2 m, 4 m, 1.5 m]",
                 "region 'layer' is to measure 0.3 m along 2, from 1.2 m to 1.5 m; of whole elements it "
                 "measures 0.25 m, from 1.25 m to 1.5 m",
                 Rank::doubtful},
        Careless{"AThickerLayer", kLayered, "1 m, 4 m, 1.5 m]", "1.1 m, 4 m, 1.5 m]",
                 "to measure 0.4 m along 2, from 1.1 m to 1.5 m; of whole elements it measures 0.5 m",
                 Rank::doubtful},
        Careless{"AWiderHole", kBank, "void: [0, 10 m, 10 m, 12 m]", "void: [-5 m, 10 m, 9.5 m, 99 m]",
                 "region 'void' is to measure 9.5 m along 1, from 0 m to 9.5 m; of whole elements it "
                 "measures 10 m, from 0 m to 10 m",
                 Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(EndsOfRegions, OddFeatures,
                         ::testing::Values(Careless{"ALayerOfWholeElements", kLayered, "", ""},
                                           Careless{"ALayerBeyondTheMesh", kLayered, "[0, 1 m, 4 m, 1.5 m]",
                                                    "[-3 m, 1 m, 7 m, 1.5 m]"},
                                           Careless{"ALayerOfSixths", kLayered, "elements: [16, 8]",
                                                    "elements: [16, 12]"},
                                           Careless{"ARoundedLayer", kLayered, "1.5 m]", "1.501 m]"}),
                         [](const auto& info) { return info.param.name; });

/// One interface of layers is told once, with the number of elements that fits: 2 m, 1.5 m and 1.2 m are 20, 15 and 12 of 0.1 m.
TEST(EndsOfRegions, OfLayersThatMeetAreToldOnce) {
  const app::Remarks remarks =
      remarks_of({"LayersThatMeet", replaced(kLayered, "[-1 m, -1 m, 9 m, 1 m]", "[-1 m, -1 m, 9 m, 1.2 m]"),
                  "1 m, 4 m, 1.5 m]", "1.2 m, 4 m, 1.5 m]"});
  ASSERT_EQ(remarks.size(), 1u) << app::text_of(remarks, true);
  EXPECT_EQ(remarks.front().remedy,
            "end it at 1 m or 1.25 m, give 20 elements along 2, or make the mesh with Gmsh");
}

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

TEST_P(OddFeatures, StayWithoutARemark) {
  const app::Remarks remarks = remarks_of(GetParam());
  EXPECT_TRUE(remarks.empty()) << app::text_of(remarks, true);
}

INSTANTIATE_TEST_SUITE_P(
    All, OddFeatures,
    ::testing::Values(
        Careless{"Wall", kWall, "", ""}, Careless{"Sheet", kSheet, "", ""}, Careless{"Bank", kBank, "", ""},
        Careless{"Joint", kJoint, "", ""},
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
        Careless{"BankWithTheStressOfItsWeight", kBank, "E: 40 MPa, nu: 0.3}\nregions: {bank: soil",
                 "E: 40 MPa, nu: 0.3}\n  fill: {model: elastic, E: 40 MPa, nu: 0.3, confining: 16 "
                 "kPa}\nregions: {bank: fill"},
        Careless{"BankOnGroundOfOneStress", kBank, "K0: 0.5, region: rest}]", "K0: 0.5}]"},
        Careless{"AFooting", kFooting, "", ""},
        Careless{"ALineAcrossAHole", kBank, kReadAlong,
                 kReadAlong + "profiles: {slope: {from: [2 m, 9 m], to: [12 m, 12 m], values: [u2]}}\n"},
        Careless{"TrafficThatGoesAgain", kBank, "pressure: 10 kPa",
                 "pressure: [[2, 0], [2.5, 10 kPa], [3, 0]]"}),
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
                                           Careless{"BesideMicroRotations",
                                                    replaced(kSpread, "kind: cauchy", "kind: cosserat"),
                                                    "nu: 0.3", "nu: 0.3, Gc: 10 MPa, lc: 1 mm"},
                                           Careless{"NothingSoftens", kSpread, "[42 deg, 30 deg]", "42 deg"},
                                           Careless{"ColumnOfOneRow",
                                                    replaced(kSpread, "[0.2 m, 0.4 m], elements: [8, 16]",
                                                             "[10 mm, 0.4 m], elements: [1, 40]"),
                                                    "-16 mm", "-0.9 mm"}),
                         [](const auto& info) { return info.param.name; });

/// A square that turns by a quarter about its lower left corner.
const std::string kTurned = R"(title: A square that turns
continuum: cauchy
deformation: large
mesh: {rectangle: {size: [1 m, 1 m], elements: [2, 2]}}
materials: {soil: {model: elastic, E: 40 MPa, nu: 0.3}}
regions: {all: soil}
boundary:
  - {on: bottom_left, fix: [u1, u2]}
  - {on: bottom_right, move: {u1: -1 m, u2: 1 m}}
  - {on: top_left, move: {u1: -1 m, u2: -1 m}}
  - {on: top_right, fix: [u2], move: {u1: -2 m}}
steps: {count: 10}
monitors: {way: {on: top_right, displacement: u1}}
)";

TEST(Turns, AreNoMovementsOfTheWrongUnit) {
  const auto told = [](const std::string& good, const std::string& bad) {
    return app::text_of(remarks_of({"Turned", kTurned, good, bad}), true);
  };
  EXPECT_EQ(told("", "").find("moves by"), std::string::npos) << told("", "");
  const std::string far = "'top_right' moves by 4000 mm, 400 % of the body (1000 mm)";
  EXPECT_NE(told("u1: -2 m", "u1: -4 m").find(far), std::string::npos) << told("u1: -2 m", "u1: -4 m");
  const std::string aside = "'bottom_left' moves by 2000 mm, 200 % of the body (1000 mm)";
  const std::string from = kTurned.substr(kTurned.find("  - {on: bottom_left"),
                                          kTurned.find("steps:") - kTurned.find("  - {on: bottom_left"));
  const std::string carried =
      "  - {on: [bottom_left, bottom_right, top_left, top_right], fix: [u2], move: {u1: 2 m}}\n";
  EXPECT_NE(told(from, carried).find(aside), std::string::npos) << told(from, carried);
}

/// A slab under 2 kPa, which strain it by less than 1e-7.
const std::string kSlab = R"(title: A slab under a crowd
continuum: cauchy
mesh: {rectangle: {size: [2 m, 0.2 m], elements: [20, 2]}}
materials: {slab: {model: elastic, E: 30 GPa, nu: 0.2}}
regions: {all: slab}
boundary:
  - {on: bottom, fix: [u1, u2]}
  - {on: top, pressure: [[0, 0], [1, 2 kPa]]}
steps: {count: 5}
monitors: {base: {on: bottom, reaction: u2}}
)";

TEST(StiffLaws, OfConcreteAndSteelAreRight) {
  const auto is_told = [](const std::string& law) {
    const app::Remarks remarks = remarks_of({"StiffLaw", kSlab, "model: elastic, E: 30 GPa, nu: 0.2", law});
    return is_told_of_features(remarks, "GPa, and loads, weight and initial stress reach 2 kPa", Rank::wrong);
  };
  EXPECT_FALSE(is_told("model: elastic, E: 30 GPa, nu: 0.2"));
  EXPECT_FALSE(is_told("model: elastic, E: 210 GPa, nu: 0.3"));
  EXPECT_TRUE(is_told("model: elastic, E: 3000 GPa, nu: 0.3"));
  EXPECT_TRUE(
      is_told("model: elastoplastic, E: 30 GPa, nu: 0.2, friction_angle: 30 deg, dilatancy_angle: 0 deg, "
              "cohesion: 1 kPa"));
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

}  // namespace
}  // namespace polargrain::testing
