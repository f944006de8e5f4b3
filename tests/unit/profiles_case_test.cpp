// SPDX-License-Identifier: GPL-2.0-or-later
// Values at places, along lines, and the start from another run as a case file has them: faults with line and remedy.
#include <gtest/gtest.h>

#include <cmath>

#include "common/prefixed_archive.hpp"
#include "coupler/case/parts.hpp"
#include "coupler/checkpoint/checkpoint.hpp"
#include "fem/mesh/box.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/end_of_run.hpp"
#include "tests/support/edited_case.hpp"

namespace polargrain::coupler {
namespace {

// Lines are counted in the expectations below.
const std::string kCaseOfProfilesCase = R"(title: A block
mesh: {rectangle: {size: [2 m, 1 m], elements: [4, 2]}}
continuum: cauchy
materials:
  soil: {model: elastic, E: 20 MPa, nu: 0.3}
regions: {all: soil}
boundary:
  - {on: bottom, fix: [u1, u2]}
monitors:
  deep: {at: [1 m, 0.5 m], stress: s22}
  settled: {at: [1 m, 1 m], displacement: u2}
profiles:
  axis: {from: [1 m, 0], to: [1 m, 1 m], points: 5, values: [s22, u2]}
  trough: {on: top, values: [u2]}
start_from: first
steps: {count: 1}
)";

class ProfilesCase : public polargrain::testing::EditedCase {
 protected:
  ProfilesCase() : EditedCase("profiles_case", kCaseOfProfilesCase) {
    std::filesystem::create_directories(directory() / "first");
    end_.identity.values = {{"materials.soil.model", "elastic"}, {"regions.all", "soil"}};
    end_.step = 3;
    keep();
  }

  void keep() { write_checkpoint(directory() / "first/checkpoint.h5", end_); }

  Checkpoint end_;
};

TEST_F(ProfilesCase, IsReadWhole) {
  const Case the_case = read();
  ASSERT_EQ(the_case.profiles.size(), 2U);
  EXPECT_EQ(the_case.profiles[0].places.size(), 5U);
  EXPECT_EQ(the_case.profiles[0].places[1], (std::vector<double>{1.0, 0.25}));
  EXPECT_EQ(the_case.profiles[1].places.size(), 9U);  // the nodes of four sides
  EXPECT_EQ(the_case.monitors[0].component.unit, "Pa");
  EXPECT_EQ(the_case.start_from, directory() / "first");
}

// Around a square of 1 m: 4 m against the clock, back to where it begins. By coordinates it would be 2 m and a diagonal.
TEST(PlacesAlong, AProfileFollowsItsCurve) {
  using Places = std::vector<std::vector<double>>;
  fem::Mesh<2> mesh = fem::rectangle({{4.0, 4.0}, {4, 4}}, "Q8R");
  mesh.boundaries["around"] = {{5, 2}, {5, 0}, {5, 3}, {5, 1}};
  EXPECT_EQ(places_along(mesh, "around"),
            (Places{{1, 1}, {1.5, 1}, {2, 1}, {2, 1.5}, {2, 2}, {1.5, 2}, {1, 2}, {1, 1.5}, {1, 1}}));
  mesh.boundaries["bent"] = {{5, 0}, {5, 3}};
  EXPECT_EQ(places_along(mesh, "bent"), (Places{{1, 2}, {1, 1.5}, {1, 1}, {1.5, 1}, {2, 1}}));
  EXPECT_EQ(places_along(mesh, "left").size(), 9U) << "from below upwards";
  EXPECT_EQ(places_along(mesh, "left").front(), (std::vector<double>{0, 0}));
  EXPECT_EQ(places_along(mesh, "all").size(), mesh.nodes.size()) << "no curve: by coordinates";
}

// Around the top of a box: 4 m, back to where it begins; along one edge from end to end.
TEST(PlacesAlong, AProfileFollowsItsCurveInSpace) {
  fem::Mesh<3> mesh = fem::box({{1.0, 1.0, 1.0}, {2, 2, 1}}, "H20R");
  std::vector<int>& rim = mesh.node_sets["rim"];
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node) {
    const Eigen::Vector3d& x = mesh.nodes[static_cast<std::size_t>(node)];
    const bool outside = x(0) == 0.0 || x(0) == 1.0 || x(1) == 0.0 || x(1) == 1.0;
    if (x(2) == 1.0 && outside) rim.push_back(node);
  }
  const auto length_of = [](const std::vector<std::vector<double>>& places) {
    double length = 0.0;
    for (std::size_t k = 1; k < places.size(); ++k) {
      double square = 0.0;
      for (std::size_t i = 0; i < 3; ++i) square += std::pow(places[k][i] - places[k - 1][i], 2);
      length += std::sqrt(square);
    }
    return length;
  };
  const auto around = places_along(mesh, "rim");
  EXPECT_EQ(around.size(), 17U);
  EXPECT_EQ(around.front(), (std::vector<double>{0, 0, 1}));
  EXPECT_EQ(around.back(), around.front());
  EXPECT_NEAR(length_of(around), 4.0, 1e-12);
  const auto edge = places_along(mesh, "top_right");
  EXPECT_EQ(edge.size(), 5U);
  EXPECT_NEAR(length_of(edge), 1.0, 1e-12);
}

// A curve with a side of its own in the middle: rows by coordinates would run to and fro between the ways.
TEST_F(ProfilesCase, ACurveThatBranchesIsAFault) {
  Faults faults;
  CaseParts parts{.directory = directory(), .result = {}, .has_mesh = true, .faults = faults};
  parts.result.problem.mesh = fem::rectangle({{4.0, 4.0}, {4, 4}}, "Q8R");
  parts.result.problem.mesh.boundaries["bent"] = {{5, 0}, {5, 3}};
  parts.result.problem.mesh.boundaries["parting"] = {{4, 2}, {5, 2}, {5, 3}};
  std::ofstream(directory() / "profiles.yaml") << "bent: {on: bent, values: [u2]}\n"
                                                  "everywhere: {on: all, values: [u2]}\n"
                                                  "tee: {on: parting, values: [u2]}\n";
  read_profiles(load_document(directory() / "profiles.yaml"), parts);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].line, 3);
  EXPECT_EQ(
      faults[0].message,
      "profile 'tee': on: 'parting' branches at [1 m, 2 m], and a profile goes one way; give each branch a name in "
      "the mesh, or a line by 'from' and 'to'");
}

TEST_F(ProfilesCase, FaultsOfPlacesNameLineAndRemedy) {
  EXPECT_EQ(
      fault("at: [1 m, 0.5 m]", "at: [3 m, 0.5 m]"),
      "10: monitor 'deep': at: this place is outside of the body; give one inside, on the mesh as it is made");
  EXPECT_EQ(fault("displacement: u2}", "stress: u2}"), "11: monitor 'settled': stress: 'u2' is no stress");
  EXPECT_EQ(fault("displacement: u2}", "on: top}"),
            "11: monitor 'settled': on: 'at' says where; keep one of them");
  EXPECT_EQ(fault("from: [1 m, 0], to: [1 m, 1 m]", "from: [3 m, 0], to: [3 m, 1 m]"),
            "13: profile 'axis': no point of this line lies in the body; give 'from' and 'to' on the "
            "mesh as it is made");
  EXPECT_EQ(
      fault("to: [1 m, 1 m]", "to: [1 m, 0]"),
      "13: profile 'axis': to: the same place as 'from'; give the other end of the line, or read one place by "
      "a monitor with 'at'");
  EXPECT_NE(
      fault("values: [s22, u2]", "values: [s22, u4]").find("13: profile 'axis': values: expected one of u1"),
      std::string::npos);
  EXPECT_NE(fault("axis:", "a/b:").find("letters, digits, _ and -"), std::string::npos);
  EXPECT_NE(fault("on: top, values", "on: tap, values").find("14: profile 'trough': on"), std::string::npos);
}

// The place that stands in for it, [1 m, 1 m], is outside of this body and an end of the line.
TEST_F(ProfilesCase, APlaceThatIsNotUnderstoodHasOneFault) {
  std::string text = kCaseOfProfilesCase;
  text.replace(text.find("size: [2 m, 1 m]"), 16, "size: [2 m, 0.5 m]");
  text.replace(text.find("at: [1 m, 1 m]"), 14, "at: [1 m, 0.5 m]");
  text.replace(text.find("start_from: first\n"), 18, "");
  const auto told = [&](const std::string& good, const std::string& bad) {
    std::string changed = text;
    changed.replace(changed.find(good), good.size(), bad);
    return faults(kCaseOfProfilesCase, changed);
  };
  EXPECT_TRUE(told("", "").empty());
  const std::vector<Fault> of_monitor = told("deep: {at: [1 m, 0.5 m]", "deep: {at: [1 m]");
  ASSERT_EQ(of_monitor.size(), 1U);
  EXPECT_NE(of_monitor[0].message.find("monitor 'deep': at: expected a list of 2"), std::string::npos);
  const std::vector<Fault> of_profile = told("from: [1 m, 0]", "from: [1 m]");
  ASSERT_EQ(of_profile.size(), 1U);
  EXPECT_NE(of_profile[0].message.find("profile 'axis': from: expected a list of 2"), std::string::npos);
}

// The case has a cauchy continuum.
TEST_F(ProfilesCase, RotationsAndCoupleStressesOfCauchyAreFaults) {
  EXPECT_EQ(fault("values: [s22, u2]", "values: [s22, w]"),
            "13: profile 'axis': values: w: a cauchy continuum has no micro-rotation, and it stays zero; set "
            "'continuum: cosserat'");
  EXPECT_EQ(fault("displacement: u2}", "displacement: w}"),
            "11: monitor 'settled': displacement: w: a cauchy continuum has no micro-rotation, and it stays "
            "zero; set 'continuum: cosserat'");
  EXPECT_EQ(fault("stress: s22", "stress: m1"),
            "10: monitor 'deep': stress: m1: a cauchy continuum has no couple stress, and it stays zero; set "
            "'continuum: cosserat'");
  std::string polar = kCaseOfProfilesCase;
  polar.replace(polar.find("continuum: cauchy"), 17, "continuum: cosserat");
  polar.replace(polar.find("nu: 0.3"), 7, "nu: 0.3, Gc: 8 MPa, lc: 1 cm");
  polar.replace(polar.find("values: [s22, u2]"), 17, "values: [w, m1]");
  polar.replace(polar.find("start_from: first\n"), 18, "");
  EXPECT_EQ(fault(kCaseOfProfilesCase, polar), "no fault");
}

// The mean of two materials, or of two blocks that slide, is the value of neither.
TEST_F(ProfilesCase, PlacesWithTwoSidesAreFaults) {
  const auto told = [&](std::vector<std::pair<std::string, std::string>> changes) {
    std::string text = kCaseOfProfilesCase;
    changes.emplace_back("start_from: first\n", "");
    for (const auto& [good, bad] : changes) text.replace(text.find(good), good.size(), bad);
    return fault(kCaseOfProfilesCase, text);
  };
  const std::pair<std::string, std::string> upper{
      "elements: [4, 2]}}", "elements: [4, 2], regions: {upper: [0, 0.5 m, 2 m, 1 m]}}}"};
  const std::pair<std::string, std::string> fill{"\nregions: {all: soil}",
                                                 "\n  fill: {model: elastic, E: 20 MPa, nu: 0.1}\n"
                                                 "regions: {upper: fill, rest: soil}"};
  const std::pair<std::string, std::string> across{"stress: s22", "stress: s11"};
  // A twentieth of the way to the middle of the lower elements, 0.25 m below.
  EXPECT_EQ(
      told({upper, fill, across}),
      "11: monitor 'deep': at: two materials meet here, and the stress has a value on each side; give a "
      "place to one side, for example [1 m, 0.4875 m]");
  EXPECT_EQ(told({upper, fill}), "no fault");  // s22 is the same on both sides of a level border
  EXPECT_EQ(told({upper, {"{all: soil}", "{upper: soil, rest: soil}"}, across}), "no fault");
  EXPECT_NE(told({upper,
                  fill,
                  {"from: [1 m, 0], to: [1 m, 1 m], points: 5, values: [s22",
                   "from: [0, 0.5 m], to: [2 m, 0.5 m], points: 5, values: [s11"}})
                .find("14: profile 'axis': from: the line runs along a border: two materials meet here"),
            std::string::npos);
  const std::pair<std::string, std::string> joint{"elements: [4, 2]}}",
                                                  "elements: [4, 2], lines: {joint: [1 m, 0, 1 m, 1 m]}}}"};
  const std::pair<std::string, std::string> slide{
      "\nmonitors:", "\ninterfaces: {slide: {on: joint, friction: 10 deg}}\nmonitors:"};
  const std::pair<std::string, std::string> beside{"at: [1 m, 0.5 m]", "at: [0.9 m, 0.5 m]"};
  const std::pair<std::string, std::string> cross{"from: [1 m, 0], to: [1 m, 1 m], points: 5",
                                                  "from: [0, 0.3 m], to: [2 m, 0.3 m], points: 5"};
  EXPECT_NE(
      told({joint, slide, beside, cross})
          .find("12: monitor 'settled': at: an interface parts the body here, and each side has its own "
                "value"),
      std::string::npos);
  EXPECT_EQ(told({joint, slide, beside, cross, {"at: [1 m, 1 m]", "at: [1.1 m, 1 m]"}}), "no fault");
}

TEST_F(ProfilesCase, SpreadSlipsTakeNoRunOver) {
  const std::string strength = ", friction_angle: 40 deg, dilatancy_angle: 5 deg, cohesion: 1 kPa";
  std::string text = kCaseOfProfilesCase;
  const auto change = [&](const std::string& good, const std::string& bad) {
    text.replace(text.find(good), good.size(), bad);
  };
  change("continuum: cauchy", "continuum: {kind: cauchy, spread: 50 cm}");
  change("model: elastic, E: 20 MPa, nu: 0.3", "model: elastoplastic, E: 20 MPa, nu: 0.3" + strength);
  EXPECT_EQ(
      fault(kCaseOfProfilesCase, text),
      "15: case: start_from: slips that are spread begin at zero and take no run over yet; leave out 'spread' "
      "or this key");
}

// The block measures 2 m x 1 m.
TEST_F(ProfilesCase, TheBodyOfTheRunBeforeIsCompared) {
  const auto keep_body = [&](double width, double height) {
    fem::EndOfRun<2> body;
    body.mesh.nodes = {{0.0, 0.0}, {width, 0.0}, {width, height}, {0.0, height}};
    body.mesh.elements = {{&fem::element_type<2>("Q4"), {0, 1, 2, 3}}};
    body.region_of_element = body.material_of_region = {0};
    body.there = {1};
    end_.state = {};
    PrefixedWriter archive(end_.state, "solver/body/");
    fem::write_end(archive, body);
    keep();
  };
  keep_body(2.0, 1.0);
  EXPECT_EQ(read().run_before->largest, (std::vector<double>{2.0, 1.0}));
  EXPECT_EQ(read().run_before->continuum, fem::Continuum::cosserat);
  end_.identity.values["continuum"] = "cauchy";
  keep_body(3.0, 1.0);
  EXPECT_EQ(read().run_before->largest, (std::vector<double>{3.0, 1.0}));
  EXPECT_EQ(read().run_before->continuum, fem::Continuum::cauchy);
  keep_body(2.0, 0.8);
  EXPECT_EQ(
      fault(),
      "15: start_from: the body in 'first' reaches from x2 = 0 m to 0.8 m, and this one has a node at 1 m, where that run "
      "has no state to give; keep to its body, or 'place' new ground in a stage");
  keep_body(2.0, 1.0);
  EXPECT_EQ(
      fault("start_from: first",
            "beams: {sheet: {on: right, EA: 1000 MN/m, EI: 1 MNm2/m}}\nstart_from: first"),
      "16: start_from: 'first' has another mesh, of 4 nodes, and this one has 37; the beam 'sheet' can be taken over on the "
      "same mesh alone: use its mesh, or 'place' what is new in a stage");
}

TEST_F(ProfilesCase, BoxesGoOverToTheSameRotationsOfGrains) {
  std::ofstream(directory() / "cell.in") << "\n";
  std::ofstream(directory() / "grains.csv")
      << "# cell xx=0.1 xy=0 yx=0 yy=0.1 z=0.1\nid,x,y,r,mass,Izz\n1,0.05,0.05,0.04,1.0,8e-4\n";
  const auto with = [](const std::string& keys) {
    std::string text = kCaseOfProfilesCase;
    const auto change = [&](const std::string& good, const std::string& bad) {
      text.replace(text.find(good), good.size(), bad);
    };
    change("continuum: cauchy", "continuum: cosserat");
    change("model: elastic, E: 20 MPa, nu: 0.3",
           "model: cell, script: cell.in, packing: grains.csv, " + keys);
    return text;
  };
  const std::string part = "G: 40 MPa, Gc: 10 MPa, lc: 20 mm";
  const std::string free = with(part);
  const std::string controlled = with("rotations: controlled");
  const auto fault_behind = [&](const std::string& before, const std::string& now) {
    std::ofstream(directory() / "before.yaml") << before;
    end_.identity = identity_of(load_document(directory() / "before.yaml"), directory());
    keep();
    return fault(kCaseOfProfilesCase, now);
  };
  EXPECT_EQ(
      fault_behind(free, controlled),
      "15: start_from: region 'all': the rotations of its grains are free in 'first' and controlled here; a box goes over "
      "to the same alone: set 'rotations: free'");
  EXPECT_EQ(
      fault_behind(controlled, free),
      "15: start_from: region 'all': the rotations of its grains are controlled in 'first' and free here; a box goes over "
      "to the same alone: set 'rotations: controlled'");
  EXPECT_EQ(fault_behind(free, with("rotations: free, " + part)), "no fault");
  EXPECT_EQ(fault_behind(controlled, controlled), "no fault");
  // Contacts may be meant to change: that is no fault.
  const auto other_scripts = [&] {
    std::ofstream(directory() / "case.yaml") << free;
    return read_case(directory() / "case.yaml").run_before->other_scripts;
  };
  EXPECT_EQ(fault_behind(free, free), "no fault");
  EXPECT_TRUE(other_scripts().empty());
  std::ofstream(directory() / "cell.in") << "# softer\n";
  EXPECT_EQ(other_scripts(), std::vector<std::string>{"all"});
}

// Springs of one model are no springs of another, whatever the name of the script. Its numbers, dashpots and order may change.
TEST_F(ProfilesCase, BoxesGoOverToTheSameContactModels) {
  std::ofstream(directory() / "grains.csv")
      << "# cell xx=0.1 xy=0 yx=0 yy=0.1 z=0.1\nid,x,y,r,mass,Izz\n1,0.05,0.05,0.04,1.0,8e-4\n";
  std::string text = kCaseOfProfilesCase;
  const auto change = [&](const std::string& good, const std::string& bad) {
    text.replace(text.find(good), good.size(), bad);
  };
  change("continuum: cauchy", "continuum: cosserat");
  change("model: elastic, E: 20 MPa, nu: 0.3",
         "model: cell, script: cell.in, packing: grains.csv, G: 40 MPa, Gc: 10 MPa, lc: 20 mm");
  const auto write_script = [&](const std::string& script) {
    std::ofstream(directory() / "cell.in") << script << "\n";
  };
  const std::string first =
      "variable sliding index history\npair_style gran model hooke/radii tangential ${sliding}";
  write_script(first);
  std::ofstream(directory() / "before.yaml") << text;
  const auto identity = [&] { return identity_of(load_document(directory() / "before.yaml"), directory()); };
  end_.identity = identity();
  keep();
  const auto fault_with = [&](const std::string& script) {
    write_script(script);
    return fault(kCaseOfProfilesCase, text);
  };
  const std::string rolls = "pair_style gran model hooke/radii tangential history rolling_friction epsd2";
  EXPECT_EQ(
      fault_with(rolls),
      "15: start_from: region 'all': its contacts are 'model hooke/radii rolling_friction epsd2 tangential history' by "
      "cell.in and were 'model hooke/radii tangential history' in 'first'; a box goes over to the same contact models alone: "
      "name the script of that run, or give its models in 'pair_style'");
  EXPECT_NE(
      fault_with("pair_style gran model hooke/radii tangential li_chu").find("tangential li_chu' by cell.in"),
      std::string::npos);
  EXPECT_EQ(
      fault_with("pair_style gran tangential history model hooke/radii rolling_friction off damping on\n"
                 "# softer"),
      "no fault");
  // A run of an older version does not tell its models; it may go on.
  ASSERT_EQ(end_.identity.values.erase(std::string("materials.soil.script") + kSprings), 1U);
  keep();
  EXPECT_EQ(fault_with(rolls), "no fault");
  write_script(first);
  EXPECT_TRUE(differences(end_.identity, identity()).empty());
}

TEST_F(ProfilesCase, FaultsOfTheStartNameLineAndRemedy) {
  EXPECT_EQ(
      fault("start_from: first", "start_from: frist"),
      "15: case: start_from: there is no folder 'frist'; give the result directory of a run, as seen from the "
      "case file");
  std::filesystem::create_directories(directory() / "empty");
  EXPECT_EQ(
      fault("start_from: first", "start_from: empty"),
      "15: case: start_from: 'empty' holds no checkpoint.h5; give the result directory of a run that has come to "
      "its end");
  EXPECT_EQ(
      fault("steps: {count: 1}",
            "steps: {count: 1}\ninitial_stress: [{surface: 1 m, unit_weight: 18 kN/m3, K0: 0.5}]"),
      "15: case: start_from: the run brings its stress; leave out 'initial_stress', or keep it and leave out this "
      "key");
  end_.identity.values["materials.soil.model"] = "elastoplastic";
  keep();
  EXPECT_EQ(
      fault(),
      "15: start_from: region 'all': is of model 'elastic' and was of model 'elastoplastic' in 'first'; a state "
      "goes over to the same model alone");
  end_.identity.values = {{"materials.soil.model", "elastic"}, {"regions.lower", "soil"}};
  keep();
  EXPECT_EQ(
      fault(),
      "15: start_from: region 'all': 'first' has no region of this name; it has lower. Give the region a name of "
      "that run, or 'place' it in a stage");
  end_.identity.values = {{"materials.soil.model", "elastic"}, {"regions.all", "soil"}};
  keep();
  EXPECT_EQ(
      fault("start_from: first\nsteps: {count: 1}",
            "water: {undrained: true}\nstart_from: first\nsteps: {duration: 1 d, count: 1}"),
      "16: start_from: 'first' has no pore water to start with; give 'water' to that run, or leave it out here");
  end_.identity.values["water.undrained"] = "true";
  keep();
  EXPECT_EQ(
      fault(),
      "15: start_from: 'first' has pore water, and its pressures would be lost; give this case 'water' too");
  end_.identity.values.erase("water.undrained");
  end_.identity.values["continuum.spread"] = "50 mm";
  keep();
  EXPECT_EQ(
      fault(),
      "15: case: start_from: 'first' spreads slips over 50 mm, which no run takes over yet; take a run without "
      "spread");
  end_.identity.values.erase("continuum.spread");
  end_.step = 0;
  keep();
  EXPECT_EQ(fault(), "15: case: start_from: 'first' has taken no step yet; run it to its end");
  std::ofstream(directory() / "first/checkpoint.h5") << "no checkpoint";
  EXPECT_NE(fault().find("15: case: start_from: "), std::string::npos);
}

}  // namespace
}  // namespace polargrain::coupler
