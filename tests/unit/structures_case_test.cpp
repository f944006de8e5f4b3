// SPDX-License-Identifier: GPL-2.0-or-later
// Interfaces, beams and anchors in a case: what they make of the mesh, and faults with line and remedy.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "common/error.hpp"
#include "coupler/case/case.hpp"
#include "coupler/case/measured_interface.hpp"
#include "coupler/case/structure_values.hpp"
#include "fem/interface/interface.hpp"
#include "fem/solver/loads.hpp"

namespace polargrain::coupler {
namespace {

/// Reads a case with a block of 2 m x 2 m and the lines given.
Case read(const std::string& lines, const std::string& boundary = "") {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("structures_case." + std::to_string(getpid()) + ".yaml");
  std::ofstream(file)
      << "title: a block\n"
         "mesh: {rectangle: {size: [2 m, 2 m], elements: [2, 4], levels: {joint: 1 m, odd: 0.25 m}}}\n"
         "materials: {ground: {model: elastic, E: 10 MPa, nu: 0.3, Gc: 2 MPa, lc: 10 mm}}\n"
         "regions: {all: ground}\n"
         "steps: {count: 1}\n"
         "boundary:\n  - {on: bottom, fix: [u1, u2]}\n"
      << boundary << lines;
  return read_case(file);
}

std::string faults_of(const std::string& lines, const std::string& boundary = "") {
  try {
    (void)read(lines, boundary);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(StructuresCase, AnInterfaceInsideDoublesItsNodes) {
  const Case the_case = read("interfaces: {slip: {on: joint, friction: 20 deg}}\n");
  EXPECT_EQ(the_case.problem.mesh.nodes_on("joint").size(), 10U);
  ASSERT_EQ(the_case.problem.contributions.size(), 1U);
  EXPECT_EQ(the_case.problem.contributions[0]->elements(), 2U);
  EXPECT_EQ(structures_of(the_case.problem, "interface"), std::vector<std::string>{"slip"});
}

TEST(StructuresCase, AnInterfaceOnTheOutlineHasARigidBody) {
  const Case the_case =
      read("interfaces: {wall: {on: left, share: 2/3}}\n", "  - {on: wall, fix: [u2], move: {u1: -1 mm}}\n");
  EXPECT_EQ(the_case.problem.mesh.nodes_on("wall").size(), 9U);
  const auto* const wall = dynamic_cast<const fem::Interface<2>*>(the_case.problem.contributions[0].get());
  ASSERT_NE(wall, nullptr);
  EXPECT_EQ(*wall->settings().share, 2.0 / 3.0);
}

TEST(StructuresCase, AWallOfBeamsHasAnInterfaceOnEachSide) {
  const Case the_case = read(
      "interfaces: {skin: {on: joint, friction: 20 deg, rotation: held}}\n"
      "beams: {plate: {on: joint, EA: 100 MN/m, EI: 1 MNm2/m, Mp: 50 kNm/m, clamped: [plate_left]}}\n"
      "anchors: {tie: {from: plate_right, to: [3 m, 1 m], EA: 20 MN/m, prestress: 5 kN/m}}\n"
      "monitors: {M: {beam: plate, value: moment}, F: {anchor: tie}, below: {interface: skin below, value: pressure}}\n",
      "  - {on: plate_left, fix: [u1, u2]}\n");
  EXPECT_EQ(structures_of(the_case.problem, "interface"),
            (std::vector<std::string>{"skin below", "skin above"}));
  EXPECT_EQ(structures_of(the_case.problem, "beam"), std::vector<std::string>{"plate"});
  ASSERT_EQ(the_case.problem.fields.size(), 1U);
  EXPECT_EQ(the_case.problem.fields[0].nodes.size(), 5U);
  EXPECT_EQ(the_case.problem.mesh.nodes_on("joint").size(), 10U) << "the ground's copies alone";
}

/// On nodes of a beam `w` is its rotation, in both continua, and not the micro-rotation of the ground there.
TEST(StructuresCase, RotationsAndMomentsOfABeamAreItsOwn) {
  for (const std::string continuum : {"cosserat", "cauchy"}) {
    const Case the_case =
        read("continuum: " + continuum + "\nbeams: {plate: {on: joint, EA: 100 MN/m, EI: 1 MNm2/m}}\n",
             "  - {on: plate_left, fix: [w]}\n  - {on: right, fix: [w]}\n"
             "  - {on: plate_right, node_force: {w: 100 kN}}\n");
    const fem::Problem<2>& problem = the_case.problem;
    ASSERT_EQ(problem.prescribed_fields.size(), 2U);
    EXPECT_EQ(problem.prescribed_fields[0].on, "plate_left");
    EXPECT_EQ(problem.prescribed_fields[1].on, "right") << "a plane of symmetry";
    EXPECT_EQ(
        std::ranges::count_if(problem.prescribed, [](const auto& item) { return item.dof == fem::Dof::w; }),
        1)
        << "the other nodes on the right";
    const Eigen::VectorXd loads = fem::Loads<2>(problem).at(1.0);
    EXPECT_EQ(loads(problem.places().entry(0, problem.mesh.nodes_on("plate_right").front())), 100e3);
    EXPECT_EQ(loads.cwiseAbs().sum(), 100e3);
  }
}

TEST(StructuresCase, WhereThereIsNoRotationNobodyGivesOne) {
  const std::string plate = "continuum: cauchy\nbeams: {plate: {on: joint, EA: 100 MN/m, EI: 1 MNm2/m}}\n";
  for (const std::string item : {"node_force: {w: 1 kN}", "traction: {w: 1 kN/m}", "move: {w: 1 deg}"}) {
    const std::string fault = faults_of(plate, "  - {on: top, " + item + "}\n");
    EXPECT_NE(fault.find("w: a cauchy continuum has no micro-rotation"), std::string::npos) << fault;
    EXPECT_NE(fault.find("such as 'plate_left'"), std::string::npos) << fault;
    const std::string in_cosserat = faults_of("", "  - {on: top, " + item + "}\n");
    EXPECT_EQ(in_cosserat.find("micro-rotation"), std::string::npos) << in_cosserat;
  }
  EXPECT_EQ(faults_of(plate, "  - {on: top, fix: [w]}\n"), "") << "it does no harm";
  EXPECT_NE(faults_of(plate + "monitors: {m: {on: bottom, reaction: w}}\n").find("value: moment"),
            std::string::npos);
  EXPECT_NE(faults_of(plate, "  - {on: joint, fix: [w]}\n").find("could not bend; name an end"),
            std::string::npos);
}

// 5 places along two elements, of two nodes each: 5 times 10 kN/m.
TEST(StructuresCase, NodesAtOnePlaceShareAForce) {
  const Case the_case = read("interfaces: {slip: {on: joint, friction: 20 deg}}\n",
                             "  - {on: joint, node_force: {u2: -10 kN/m}}\n");
  EXPECT_EQ(fem::Loads<2>(the_case.problem).at(1.0).sum(), -50e3);
}

TEST(StructuresCase, AWrongKeyIsOneFault) {
  const std::string rest =
      "beams: {plate: {on: joint, EA: 100 MN/m, EI: 1 MNm2/m, clamped: [plate_left]}}\n"
      "anchors: {tie: {from: plate_right, to: [3 m, 1 m], EA: 20 MN/m}}\n"
      "monitors: {M: {beam: plate, value: moment}, F: {anchor: tie}, below: {interface: skin below, value: pressure}}\n";
  const std::string supports = "  - {on: plate_left, fix: [u1, u2]}\n";
  EXPECT_EQ(faults_of("interfaces: {skin: {on: joint, friction: 20 deg}}\n" + rest, supports), "");
  const std::string fault = faults_of("interfaces: {skin: {on: joint, friction: 95 deg}}\n" + rest, supports);
  EXPECT_NE(fault.find("friction: must be below 80 deg"), std::string::npos) << fault;
  EXPECT_EQ(std::ranges::count(fault, '\n'), 0) << fault;
}

TEST(StructuresCase, AWrongValueOfABeamOrAnAnchorIsOneFault) {
  const std::string good =
      "interfaces: {skin: {on: joint, friction: 20 deg}}\n"
      "beams: {plate: {on: joint, EA: 100 MN/m, EI: 1 MNm2/m, clamped: [plate_left]}}\n"
      "anchors: {tie: {from: plate_right, to: [3 m, 1 m], EA: 20 MN/m, strength: 9 kN/m, prestress: 5 kN/m}}\n"
      "monitors: {M: {beam: plate, value: moment}, F: {anchor: tie}}\n";
  const std::string supports = "  - {on: plate_left, fix: [u1, u2]}\n";
  EXPECT_EQ(faults_of(good, supports), "");
  struct Slip {
    std::string right, wrong, message;
  };
  for (const Slip& slip :
       {Slip{"prestress: 5 kN/m", "prestress: 80 kPa", "anchor 'tie': prestress: expected"},
        Slip{"prestress: 5 kN/m", "prestress: -5 kN/m", "found '-5 kN/m'"},
        Slip{"strength: 9 kN/m", "strength: 9 kPa", "anchor 'tie': strength: expected"},
        Slip{"EA: 20 MN/m, ", "", "anchor 'tie': the key 'EA' is missing"},
        Slip{"from: plate_right", "from: nowhere", "no boundary or node set 'nowhere'"},
        Slip{"from: plate_right, ", "", "anchor 'tie': the key 'from' is missing"},
        Slip{"EI: 1 MNm2/m", "EI: 1 kPa", "beam 'plate': EI: expected"},
        Slip{"EI: 1 MNm2/m", "EI: -1 MNm2/m", "EI: must be greater than zero"},
        Slip{"on: joint, EA", "on: joints, EA", "no boundary or node set 'joints'"}}) {
    std::string lines = good;
    const std::string fault =
        faults_of(lines.replace(lines.find(slip.right), slip.right.size(), slip.wrong), supports);
    EXPECT_NE(fault.find(slip.message), std::string::npos) << fault;
    EXPECT_EQ(std::ranges::count(fault, '\n'), 0) << fault;
  }
}

TEST(StructuresCase, FaultsNamePlaceAndRemedy) {
  const auto expect = [](const std::string& lines, const std::string& part,
                         const std::string& boundary = "") {
    const std::string faults = faults_of(lines, boundary);
    EXPECT_NE(faults.find(part), std::string::npos) << lines << "\n" << faults;
    EXPECT_NE(faults.find("yaml:"), std::string::npos) << "a line: " << faults;
  };
  expect("interfaces: {a: {on: nowhere, friction: 20 deg}}\n", "no boundary or node set 'nowhere'");
  expect("interfaces: {a: {on: odd, friction: 20 deg}}\n", "make up no whole side");
  expect("interfaces: {a: {on: joint}}\n", "expected either 'friction'");
  expect("interfaces: {a: {on: joint, friction: 20 deg, share: 2/3}}\n", "expected either 'friction'");
  expect("interfaces: {a: {on: joint, share: 3/2}}\n", "a part of the friction");
  expect("interfaces: {a: {on: joint, friction: 85 deg}}\n", "below 80 deg");
  // atan(0.7) is 34.99 deg; read as an angle it is 40.1 deg, of a coefficient of 0.84.
  expect(
      "interfaces: {a: {on: joint, friction: 0.7}}\n",
      "friction: expected an angle with its unit, found '0.7'; write '35 deg' for a coefficient of 0.7, or '0.7 rad'");
  expect("interfaces: {a: {on: joint, friction: 20 deg, dilation: 25 deg}}\n",
         "not be larger than the friction");
  expect("interfaces: {a: {on: joint, friction: 20 deg, tension: 1 kPa}}\n", "cohesion / tan(friction)");
  expect("interfaces: {a: {on: joint, friction: 20 deg}, b: {on: joint, friction: 5 deg}}\n",
         "one interface");
  expect("interfaces: {a: {on: left, friction: 20 deg}}\n", "{on: a, fix: [u1]}");
  expect("interfaces: {left: {on: left, friction: 20 deg}}\n", "a part of this name");
  expect("beams: {a: {on: left, EA: 1 MN/m}}\n", "EI");
  expect("beams: {a: {on: left, EA: 1 MN/m, EI: 10 kNm, clamped: [nowhere]}}\n", "'nowhere'");
  expect("anchors: {a: {from: left, to: [5 m, 5 m], EA: 1 MN/m}}\n", "has 9 nodes");
  expect("anchors: {a: {from: top_left, to: [0 m, 2 m], EA: 1 MN/m}}\n", "no length");
  expect("anchors: {a: {from: top_left, to: [5 m, 5 m], EA: 1 MN/m, strength: 1 kN/m, prestress: 2 kN/m}}\n",
         "beyond the strength");
  expect("anchors: {a: {from: top_left, to: [5 m, 5 m], EA: 1 MN/m, prestress: -2 kN/m}}\n",
         "prestress: expected a tension, zero or greater, found '-2 kN/m'; write it without the minus");
  expect("deformation: large\ninterfaces: {a: {on: joint, friction: 20 deg}}\n", "small deformation");
  expect("interfaces: {a: {on: joint, friction: 20 deg}}\nmonitors: {m: {interface: b, value: gap}}\n",
         "no interface 'b'");
  expect("interfaces: {a: {on: joint, friction: 20 deg}}\nmonitors: {m: {interface: a, value: moment}}\n",
         "pressure");
}

/// A block of 4 m x 4 m with a pit that has been dug, and a wall beside it.
std::string faults_beside_pit(const std::string& lines) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("pit_case." + std::to_string(getpid()) + ".yaml");
  std::ofstream(file)
      << "title: a pit\ncontinuum: cauchy\n"
         "mesh: {rectangle: {size: [4 m, 4 m], elements: [4, 4], regions: {void: [0, 2 m, 2 m, 4 m]}, "
         "lines: {wall: [2 m, 0, 2 m, 4 m], short: [1 m, 0, 1 m, 1 m]}}}\n"
         "materials: {ground: {model: elastic, E: 10 MPa, nu: 0.3}}\n"
         "regions: {rest: ground}\nsteps: {count: 1}\n"
         "boundary:\n  - {on: bottom, fix: [u1, u2]}\n"
      << lines;
  try {
    (void)read_case(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(StructuresCase, AWallBesideAPitNeedsABeam) {
  const std::string skin = "interfaces: {skin: {on: wall, friction: 20 deg}}\n";
  const std::string beam = "beams: {sheet: {on: wall, EA: 100 MN/m, EI: 1 MNm2/m}}\n";
  EXPECT_EQ(faults_beside_pit(skin + beam), "");
  const std::string alone = faults_beside_pit(skin);
  EXPECT_NE(
      alone.find(
          "yaml:9: interface 'skin': on: 'wall' has ground on both sides, and on one side alone at (2, "),
      std::string::npos)
      << alone;
  EXPECT_NE(alone.find("give it a beam too ('beams: {NAME: {on: wall, EA: ..., EI: ...}}'), or end it there"),
            std::string::npos)
      << alone;
  const std::string taken = faults_beside_pit(
      skin +
      "beams: {sheet: {on: wall, EA: 100 MN/m, EI: 1 MNm2/m}, skin left: {on: short, EA: 100 MN/m, EI: 1 MNm2/m}}\n");
  EXPECT_NE(taken.find("its left side is 'skin left', a name that another"), std::string::npos) << taken;
}

constexpr const char* kMeasured =
    "mean_diameter: 0.01 m\nscript: 0123\npressure: 100000 Pa\nboxes: 3\nheight: 10\nwalls:\n"
    "  - roughness: 0.25\n    friction: [[0, 0.2], [0.001, 0.4], [0.01, 0.3]]\n    friction_interval: [0.1, 0.1, 0.1]\n"
    "    opening: [[0, 0], [0.001, 1e-4], [0.01, 5e-4]]\n    turning: 0.15\n    peak: [0.4, 0.1]\n    end: [0.3, 0.1]\n"
    "  - {roughness: 1, friction: [[0, 0.5]], opening: [[0, 0]], turning: 0}\n";

/// A packing of two grains of 10 mm, and what was measured of such.
class MeasuredFriction : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(packing_) << "# cell xx=0.02 xy=0 yx=0 yy=0.02 z=1\nid,x,y,r,mass,Izz\n"
                               "1,0.005,0.005,0.005,1,1\n2,0.015,0.015,0.005,1,1\n";
    measure(kMeasured);
  }
  void TearDown() override {
    std::filesystem::remove(packing_);
    std::filesystem::remove(file_);
  }
  void measure(const std::string& text) { std::ofstream(file_) << text; }
  [[nodiscard]] std::string wall(const std::string& keys) const {
    return "interfaces: {wall: {on: left, friction: measured, packing: " + packing_.string() + ", " + keys +
           "}}\n";
  }

  const std::string body_ = "  - {on: wall, fix: [u1, u2]}\n";
  const std::filesystem::path packing_ =
      std::filesystem::temp_directory_path() / ("measured." + std::to_string(getpid()) + ".csv");
  const std::filesystem::path file_ = interface_file_of(packing_);
};

TEST_F(MeasuredFriction, IsTheLawOfTheInterface) {
  const Case the_case = read(wall("roughness: 0.25, rotation: measured"), body_);
  const auto* const wall = dynamic_cast<const fem::Interface<2>*>(the_case.problem.contributions[0].get());
  ASSERT_NE(wall, nullptr);
  const fem::InterfaceParameters& law = wall->settings().parameters;
  ASSERT_NE(law.over_slip, nullptr);
  EXPECT_DOUBLE_EQ(law.over_slip->friction(0.5e-3), 0.3);
  EXPECT_DOUBLE_EQ(law.over_slip->friction(1.0), 0.3);
  EXPECT_DOUBLE_EQ(law.over_slip->pieces()[0].tan_dilation, 0.1);
  EXPECT_DOUBLE_EQ(wall->settings().turning, 15.0) << "rad/m";
  EXPECT_FALSE(wall->face(0).rotation_b.empty());
  EXPECT_EQ(the_case.identity.files.count("interfaces.wall.friction"), 1U) << "a checkpoint knows it";
}

TEST_F(MeasuredFriction, FaultsNamePlaceAndRemedy) {
  const auto expect = [&](const std::string& lines, const std::string& part) {
    const std::string faults = faults_of(lines, body_);
    EXPECT_NE(faults.find(part), std::string::npos) << lines << "\n" << faults;
    EXPECT_NE(faults.find("yaml:9: interface 'wall'"), std::string::npos) << "file and line: " << faults;
  };
  expect(wall("roughness: 0.5"), "has 0.25, 1; take one of these, or measure with 'polargrain interface");
  expect(wall("rotation: held"), "roughness");
  expect(wall("roughness: 1, dilation: 3 deg"), "dilation: comes with 'friction: measured'");
  expect("interfaces: {wall: {on: left, friction: measured, roughness: 1}}\n", "write 'packing: FILE'");
  expect("interfaces: {wall: {on: left, friction: measured, roughness: 1, packing: none.h5}}\n",
         "there is no file 'none.h5'");
  expect("interfaces: {wall: {on: left, friction: 20 deg, rotation: measured}}\n",
         "comes from the box that 'friction: measured' reads");
  std::string other = kMeasured;
  measure(other.replace(other.find("0.01 m"), 6, "0.02 m"));
  expect(wall("roughness: 1"), "is of grains of 20 mm, the grains of the packing have 10 mm");
  other = kMeasured;
  measure(other.replace(other.find("[0, 0.2]"), 8, "[1, 0.2]"));
  expect(wall("roughness: 1"), "interface.yaml:8: wall: friction: the first value of a pair must be larger");
  std::filesystem::remove(file_);
  expect(wall("roughness: 1"), "--roughness 1' makes the experiment and writes it, or give an angle");
}

}  // namespace
}  // namespace polargrain::coupler
