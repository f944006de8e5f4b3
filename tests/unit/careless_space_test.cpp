// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies in space with one thing wrong each, and odd ones that are right.
#include <fmt/format.h>

#include <climits>
#include <cmath>
#include <map>
#include <set>

#include "app/remarks/kinds.hpp"
#include "app/remarks/sizes.hpp"
#include "coupler/case/document_kind.hpp"
#include "tests/support/careless_features.hpp"

namespace polargrain::testing {
namespace {

using app::Rank;

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

/// The same block, at rest under its weight and a surcharge.
const std::string kBlockAtRest =
    replaced(replaced(kBlock, "pressure: [[0, 0], [1, 30 kPa]]", "pressure: [[0, 10 kPa], [1, 30 kPa]]"),
             "  - {force: [0, 0, -18 kN/m3], factor: [[0, 0], [1, 1]]}\n",
             "  - {unit_weight: 18 kN/m3}\n"
             "initial_stress: [{surface: 2 m, unit_weight: 18 kN/m3, K0: 0.5, surcharge: 10 kPa}]\n");

const std::string kRollers = "  - {on: [left, right], fix: [u1]}\n";
const std::string kRollersAndPressure =
    "  - {on: left, fix: [u1]}\n  - {on: right, pressure: [[0, 0], [1, 10 kPa]]}\n";

const std::string kBlockInPlaneStrain =
    replaced(kBlock, "dilatancy_angle: 2 deg", "dilatancy_angle: 2 deg, match: plane_strain");

/// A rough plate presses the block.
const std::string kPressed =
    replaced(replaced(kBlock, "pressure: [[0, 0], [1, 30 kPa]]", "fix: [u1, u2], move: {u3: -5 mm}"),
             "monitors: {base: {on: bottom, reaction: u3}}\noutput: {table: [base]}",
             "monitors: {force: {on: top, reaction: u3}, way: {on: top, displacement: u3}}");

/// The block on a rigid base that it may slide on.
const std::string kOnABase = replaced(
    replaced(replaced(kBlock, "{on: bottom, fix: [u1, u2, u3]}", "{on: floor, fix: [u1, u2, u3]}"),
             "{base: {on: bottom, reaction: u3}}", "{base: {on: floor, reaction: u3}}"),
    "boundary:", "interfaces: {floor: {on: bottom, friction: 20 deg, normal_stiffness: 1 GPa/m}}\nboundary:");

INSTANTIATE_TEST_SUITE_P(
    InSpaceAsInThePlane, CarelessFeatures,
    ::testing::Values(
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
        Careless{"CompressionConeInPlaneStrain", kBlock, kRollers, kRollersAndPressure,
                 "both ends along 2 are held: in plane strain this cone has", Rank::doubtful},
        Careless{"ASideThatNobodyHolds", kBlockInPlaneStrain, "{on: [front, back], fix: [u2]}",
                 "{on: back, fix: [u2]}",
                 "its lower end along 2 is free over the whole height (2 m) under weight"},
        Careless{"TwoSidesThatNobodyHolds", kBlockInPlaneStrain, "  - {on: [left, right], fix: [u1]}\n", "",
                 "both ends of the mesh along 1 are free over the whole height (2 m) under weight"},
        Careless{"ALoadTheStressDoesNotHave", kBlockAtRest, "[[0, 10 kPa], [1, 30 kPa]]",
                 "[[0, 60 kPa], [1, 70 kPa]]",
                 "'top' carries 60 kPa at time zero, the initial stress behind it 10 kPa"},
        Careless{"ASoftInterface", kOnABase, "1 GPa/m", "10 MPa/m",
                 "normal_stiffness of 10 MPa/m is 0.37 of Eoed/h of the element beside it", Rank::doubtful},
        Careless{"AnInterfaceAboveTheGround", kOnABase, "friction: 20 deg", "friction: 35 deg",
                 "its friction of 35 deg is above the 32 deg of material 'soil'", Rank::doubtful},
        Careless{"AnAnchorIntoTheGround", kBlock, "boundary:",
                 "anchors: {rod: {from: top_front_left, to: [2.5 m, 2.5 m, 0.5 m], EA: 1 MN}}\nboundary:",
                 "its far end (2.5, 2.5, 0.5) m lies within region 'all' and is fixed there", Rank::doubtful},
        Careless{"AToleranceWithoutWorth", kBlock, "tolerance: 1e-5", "tolerance: 0.4",
                 "tolerance: 0.4 of the forces may be out of balance"},
        Careless{"WeightAtOnce", kBlock, ", factor: [[0, 0], [1, 1]]}", "}",
                 "18 kN/m3 act on region 'all' from time zero, and it has no stress then", Rank::doubtful},
        Careless{"AHeavierStress", kBlockAtRest, "surface: 2 m, unit_weight: 18 kN/m3",
                 "surface: 2 m, unit_weight: 22 kN/m3", "a unit weight of 22 kN/m3, and region 'all' has 18",
                 Rank::doubtful},
        Careless{"ASilo", kBlock, "{on: [left, right], fix: [u1]}", "{on: [left, right], fix: [u1, u3]}",
                 "u3 is fixed along 'left' and 'right'", Rank::doubtful},
        Careless{"FlatElements", kBlock, "elements: [2, 2, 1]", "elements: [2, 2, 25]",
                 "mesh: its elements are up to 25 times as long as wide", Rank::doubtful},
        Careless{"ALoadThatPulls", kBlock, "[[0, 0], [1, 30 kPa]]", "[[0, 0], [1, -30 kPa]]",
                 "a pressure of -30 kPa on 'top' pulls"},
        Careless{"CarriedAlong",
                 replaced(kPressed, "{on: bottom, fix: [u1, u2, u3]}",
                          "{on: bottom, fix: [u1, u2], move: {u3: -5 mm}}"),
                 "monitors: {force: {on: top, reaction: u3}, way: {on: top, displacement: u3}}", "",
                 "all that is given along 3 moves by"},
        Careless{"AForceOverALength", kBlock, "base: {on: bottom, reaction: u3}",
                 "base: {on: bottom, reaction: u3}, pressure: -base / 4 m",
                 "a force in space acts on an area, and '4 m' is a length"},
        Careless{
            "AForceOverAnotherSection", kBlock, "base: {on: bottom, reaction: u3}",
            "base: {on: bottom, reaction: u3}, pressure: -base / (4 m * 2 m)",
            "'4 m' times '2 m' is the section along 2 and 3 of the body, and the boundary of 'base' is 16 m2",
            Rank::doubtful},
        Careless{"AShorteningOverAWidth",
                 replaced(kPressed, "way: {on: top, displacement: u3}}",
                          "way: {on: top, displacement: u3}, strain: -way / 2 m}"),
                 "-way / 2 m", "-way / 4 m", "'4 m' is the side along 1 of the body, and its height is 2 m",
                 Rank::doubtful},
        Careless{"AMeanAlongASide", kPressed, "{on: top, displacement: u3}", "{on: left, displacement: u3}",
                 "the mean of u3 along 'left', from one end of the body to the other; 'top', which is moved",
                 Rank::doubtful},
        Careless{"AForceAcross", kPressed, "{on: top, reaction: u3}", "{on: top, reaction: u1}",
                 "'top' is moved along u3, and no monitor reads the force along it: this one is along u1",
                 Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

/// A quarter of a square footing on clay.
const std::string kSquare = R"(title: A square footing on clay
continuum: cauchy
mesh: {element: H8, box: {size: [5 m, 5 m, 3 m], elements: [15, 15, 9], patch: [1 m, 1 m, 3 m]}}
materials:
  clay: {model: elastoplastic, E: 10 MPa, nu: 0.45, friction_angle: 0 deg, dilatancy_angle: 0 deg, cohesion: 20 kPa}
regions: {patch: clay, rest: clay}
boundary:
  - {on: bottom, fix: [u1, u2, u3]}
  - {on: [left, right], fix: [u1]}
  - {on: [front, back], fix: [u2]}
  - {on: top_patch, fix: [u1, u2], move: {u3: -80 mm}}
steps: {count: 16, tolerance: 1e-4}
monitors:
  force: {on: top_patch, reaction: u3}
  capacity: -force / (1 m * 1 m * 20 kPa)
)";

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

/// A quarter of it.
const std::string kQuarter =
    replaced(replaced(kCylinder, "elements: [8, 2, 6]}", "elements: [8, 2, 6], sector: quarter}"),
             "  - {on: bottom_axis, fix: [u1, u2]}\n  - {on: bottom_side_right, fix: [u2]}\n",
             "  - {on: left, fix: [u1]}\n  - {on: front, fix: [u2]}\n");

/// The cut of a sector is no side of the body: a cylinder 100 mm wide may have an lc of 20 mm, a quarter of it 50 mm wide too.
TEST(Sectors, AreAsWideAsTheirCylinder) {
  const std::string law =
      "elastoplastic, E: 40 MPa, nu: 0.3, friction_angle: 32 deg, dilatancy_angle: 2 deg, cohesion: 1 kPa";
  for (const std::string& text : {kCylinder, kQuarter}) {
    const std::string polar = replaced(text, "continuum: cauchy\n", "");
    const app::Remarks right =
        remarks_of({"SectorsRight", polar, law, "elastic, E: 40 MPa, nu: 0.3, Gc: 15 MPa, lc: 20 mm"});
    EXPECT_TRUE(right.empty()) << app::text_of(right, true);
    const app::Remarks wide =
        remarks_of({"SectorsWide", polar, law, "elastic, E: 40 MPa, nu: 0.3, Gc: 15 MPa, lc: 30 mm"});
    EXPECT_TRUE(is_told_of_features(wide, "lc is 30 mm, 0.3 times the smaller side of the body (100 mm)",
                                    Rank::doubtful))
        << app::text_of(wide, true);
  }
}

TEST(Sectors, HaveTheSizesOfTheirCylinder) {
  const Scratch scratch("careless_sector_sizes");
  const std::filesystem::path file = scratch.path() / "case.yaml";
  write(file, kQuarter);
  const coupler::Case the_case = coupler::read_case(file);
  const coupler::Entry document = coupler::load_document_of(coupler::DocumentKind::problem, file, {});
  const app::PackingsAtRest no_packings;
  const std::string sizes = app::sizes_text(app::Scene(the_case, document, no_packings));
  EXPECT_TRUE(sizes.starts_with("body 100 mm by 100 mm by 200 mm (the mesh is a quarter of it), elements "))
      << sizes;
  EXPECT_NE(sizes.find("largest movement 4 mm, 4 % of the smaller side\n"), std::string::npos) << sizes;
}

/// The stress is told with its cause: loads and the stress at the surface no longer agree.
TEST(SurfaceInSpace, AboveTheMeshIsTold) {
  const app::Remarks remarks =
      remarks_of({"SurfaceAboveTheMesh", kBlockAtRest, "surface: 2 m", "surface: 3 m"});
  EXPECT_TRUE(is_told_of_features(remarks, "the surface is at 3 m, and the highest point of the mesh at 2 m",
                                  Rank::wrong))
      << app::text_of(remarks, true);
}

INSTANTIATE_TEST_SUITE_P(
    Space, CarelessFeatures,
    ::testing::Values(
        Careless{
            "SquareFootingOnTwoElements", kSquare, "elements: [15, 15, 9]", "elements: [10, 10, 6]",
            "'top_patch' is moved and measures 2 elements across: where it ends the stress has no bound, and the load "
            "of failure is up to 20 % too high",
            Rank::doubtful},
        Careless{"ForceOfAQuarterOverTheCircle", kQuarter, "force: {on: top, reaction: u3}",
                 "force: {on: top, reaction: u3}, ratio: -force / (3.14159 * 5 cm * 5 cm * 100 kPa)",
                 "divides by 0.007854 m2, and the boundary of 'force' has", Rank::doubtful},
        Careless{"APolygonForACircle", kCylinder, "elements: [8, 2, 6]", "elements: [4, 2, 6]",
                 "is a polygon of 16 sides, 2.6 % smaller than the circle", Rank::doubtful},
        Careless{"WeightAlongTheSecondAxis", kBlock, "[0, 0, -18 kN/m3]", "[0, -18 kN/m3, 0]",
                 "and 3 points up: nothing pulls the body down"},
        Careless{"WeightOfADensity", kBlock, "-18 kN/m3]", "-1800]", "a weight of 1.8 kN/m3"},
        Careless{"PoissonInSpace", kBlock, "nu: 0.3", "nu: 0.03", "nu is 0.03", Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Space, OddFeatures,
    ::testing::Values(
        Careless{"Block", kBlock, "", ""}, Careless{"ABlockAtRest", kBlockAtRest, "", ""},
        Careless{
            "ALoadOfAStage", replaced(kBlockAtRest, "[[0, 10 kPa], [1, 30 kPa]]", "10 kPa"),
            "steps: {count: 5, tolerance: 1e-5}",
            "steps: {tolerance: 1e-5, stages: [{name: rest, count: 1}, {name: load, count: 2, boundary: [{on: top, "
            "pressure: 20 kPa}]}]}"},
        Careless{"PlaneStrainThatIsSaid", replaced(kBlock, kRollers, kRollersAndPressure),
                 "dilatancy_angle: 2 deg", "dilatancy_angle: 2 deg, match: plane_strain"},
        Careless{"ARoundCylinder", kCylinder, "", ""},
        Careless{"ACurvedCylinder", kCylinder,
                 "H8, cylinder: {radius: 5 cm, height: 20 cm, elements: [8, 2, 6]}",
                 "H20R, cylinder: {radius: 5 cm, height: 20 cm, elements: [2, 1, 4]}"},
        Careless{"OnABase", kOnABase, "", ""},
        Careless{
            "AnElasticCantilever", replaced(kBlock, kRollers, ""),
            "model: elastoplastic, E: 40 MPa, nu: 0.3, friction_angle: 32 deg, dilatancy_angle: 2 deg, cohesion: 15 kPa",
            "model: elastic, E: 40 MPa, nu: 0.3"},
        Careless{"AnAnchorBeyondTheMesh", kBlock, "boundary:",
                 "anchors: {rod: {from: top_front_left, to: [-2 m, -2 m, 0.5 m], EA: 1 MN}}\nboundary:"},
        Careless{"ARoughPlate", kPressed, "", ""}, Careless{"ASquareFooting", kSquare, "", ""},
        Careless{"AStressOfABlock", kBlock, "base: {on: bottom, reaction: u3}",
                 "base: {on: bottom, reaction: u3}, pressure: -base / (4 m * 4 m)"},
        Careless{"AStressOfAQuarter", kQuarter, "force: {on: top, reaction: u3}",
                 "force: {on: top, reaction: u3}, stress: -force * 4 / (3.14159 * 5 cm * 5 cm)"},
        Careless{"AColumnThatStandsFree", replaced(kBlockInPlaneStrain, kRollers, ""),
                 "size: [4 m, 4 m, 2 m]", "size: [2 m, 2 m, 4 m]"},
        Careless{"ShakenSideways", kBlock, "force: [0, 0, -18 kN/m3]", "force: [3 kN/m3, 0, -18 kN/m3]"}),
    [](const auto& info) { return info.param.name; });

/// Cuts a block across in its middle, x1 = 2 m, in half: the right half gets nodes of its own. The number of these.
std::size_t cut_across(fem::Mesh<3>& mesh) {
  std::map<int, int> copies;
  for (fem::Element<3>& element : mesh.elements) {
    const auto is_right = [&](int node) { return mesh.nodes[static_cast<std::size_t>(node)].x() > 2.1; };
    if (std::ranges::none_of(element.nodes, is_right)) continue;
    for (int& node : element.nodes) {
      const Eigen::Vector3d place = mesh.nodes[static_cast<std::size_t>(node)];
      if (std::abs(place.x() - 2.0) > 1e-9) continue;
      const auto [copy, is_new] = copies.emplace(node, static_cast<int>(mesh.nodes.size()));
      if (is_new) mesh.nodes.push_back(place);
      node = copy->second;
    }
  }
  return copies.size();
}

TEST(Seams, InSpaceAreTold) {
  const Scratch scratch("careless_seam");
  write(scratch.path() / "case.yaml", kBlock);
  coupler::Case the_case = coupler::read_case(scratch.path() / "case.yaml");
  const std::size_t copies = cut_across(the_case.space->mesh);
  const app::Remarks remarks = app::remarks_on(the_case, std::vector<std::string>{}, {});
  EXPECT_TRUE(is_told_of_features(
      remarks, fmt::format("mesh: {} pairs of nodes lie at one place each", copies), Rank::wrong))
      << app::text_of(remarks, true);
}

/// The right half, 0.3 m further along x2: of 13 nodes in the cut of each half 10 lie within faces of the other.
TEST(Seams, InSpaceThatDoNotMeetAreTold) {
  const Scratch scratch("careless_shifted_seam");
  write(scratch.path() / "case.yaml", kBlock);
  coupler::Case the_case = coupler::read_case(scratch.path() / "case.yaml");
  fem::Mesh<3>& mesh = the_case.space->mesh;
  ASSERT_EQ(cut_across(mesh), 13U);
  std::set<int> right;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
    if (mesh.element_positions(e).col(0).maxCoeff() < 2.1) continue;
    mesh.regions["right"].push_back(e);
    const std::vector<int>& nodes = mesh.elements[static_cast<std::size_t>(e)].nodes;
    right.insert(nodes.begin(), nodes.end());
  }
  for (const int node : right) mesh.nodes[static_cast<std::size_t>(node)].y() += 0.3;
  const coupler::Entry document =
      coupler::load_document_of(coupler::DocumentKind::problem, the_case.file, {});
  const auto remarks_now = [&] {
    const app::PackingsAtRest none;
    app::Remarks remarks;
    app::hanging_nodes(app::Scene(the_case, document, none), remarks);
    return remarks;
  };
  EXPECT_TRUE(is_told_of_features(
      remarks_now(), "20 nodes lie within sides of elements that do not have them", Rank::wrong));
  the_case.space->lifetimes["right"] = {1, INT_MAX};
  EXPECT_TRUE(remarks_now().empty()) << "halves that are never there at once";
  the_case.space->lifetimes.clear();
  for (const int node : right) mesh.nodes[static_cast<std::size_t>(node)].x() += 1e-3;
  EXPECT_TRUE(remarks_now().empty()) << "across a gap";
}

}  // namespace
}  // namespace polargrain::testing
