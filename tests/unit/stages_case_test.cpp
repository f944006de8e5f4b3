// SPDX-License-Identifier: GPL-2.0-or-later
// Stages of construction as a case file has them.
#include <gtest/gtest.h>

#include "tests/support/edited_case.hpp"

namespace polargrain::coupler {
namespace {

// Lines are counted in the expectations below.
const std::string kCase = R"(title: A pit, a strut, a bank
continuum: cauchy
mesh:
  rectangle:
    size: [20 m, 12 m]
    elements: [10, 12]
    regions: {pit: [0, 6 m, 4 m, 10 m], bank: [12 m, 10 m, 20 m, 12 m], void: [0, 10 m, 12 m, 12 m]}
    lines: {wall: [4 m, 6 m, 4 m, 10 m], floor: [0, 6 m, 4 m, 6 m]}
materials:
  soil: {model: elastic, E: 20 MPa, nu: 0.3}
regions: {pit: soil, bank: soil, rest: soil}
boundary:
  - {on: left, fix: [u1]}
  - {name: side, on: right, fix: [u1]}
  - {on: bottom, fix: [u2]}
  - {name: strut, on: wall, fix: [u1]}
body: [{unit_weight: 18 kN/m3}]
initial_stress: [{surface: 10 m, unit_weight: 18 kN/m3, K0: 0.6}]
steps:
  stages:
    - {name: rest, count: 2}
    - {name: dig, remove: pit, count: 4, reset_displacements: yes}
    - {name: wet, count: 2, boundary: [{name: water, on: floor, pressure: 20 kPa}]}
    - {name: bank, place: bank, end: [strut, water], count: 3, until: 5}
    - {name: pull, count: 5, boundary: [{on: right, move: {u1: 2 mm}, name: side}]}
)";

class StagesCase : public polargrain::testing::EditedCase {
 protected:
  StagesCase() : EditedCase("stages_case", kCase) {}
};

TEST_F(StagesCase, is_one_list_of_steps_and_of_what_comes_and_goes) {
  const Case the_case = read();
  ASSERT_EQ(the_case.stages.size(), 5U);
  EXPECT_EQ(the_case.plan.size(), 16U);
  EXPECT_EQ(the_case.stage_of(0), nullptr);
  EXPECT_EQ(the_case.stage_of(6)->name, "dig");
  EXPECT_TRUE(the_case.stage_of(6)->resets_displacements);
  EXPECT_EQ(the_case.stages[0].number, 0);  // nothing comes or goes
  EXPECT_EQ(the_case.stages[4].number, 4);
  EXPECT_DOUBLE_EQ(the_case.plan[3].amount, 1.5);
  EXPECT_DOUBLE_EQ(the_case.plan[3].released, 0.5);
  EXPECT_DOUBLE_EQ(the_case.plan[15].amount, 6.0);  // one more than the stage before
  const fem::Problem<2>& problem = the_case.problem;
  EXPECT_EQ(problem.stages, (std::vector<std::string>{"start", "dig", "wet", "bank", "pull"}));
  EXPECT_EQ(problem.lifetimes.at("pit").end, 1);
  EXPECT_EQ(problem.lifetimes.at("bank").begin, 3);
  EXPECT_FALSE(problem.mesh.regions.contains("void"));
  EXPECT_EQ(problem.mesh.elements.size(), 120U - 12U);
  EXPECT_EQ(problem.mesh.boundaries.at("floor").size(), 2U);
  const auto& strut = problem.prescribed[3];
  EXPECT_EQ(strut.on, "wall");
  EXPECT_EQ(strut.life.end, 3);
  EXPECT_EQ(problem.boundary_loads.front().life.begin, 2);
  EXPECT_EQ(problem.boundary_loads.front().life.end, 3);
  const auto& pull = problem.prescribed.back();
  EXPECT_EQ(pull.life.begin, 4);
  EXPECT_TRUE(pull.from_here);
  EXPECT_EQ(pull.value.at(5.0), 0.0);
  EXPECT_DOUBLE_EQ(pull.value.at(6.0), 2e-3);
}

TEST_F(StagesCase, tells_what_is_wrong_with_its_stages) {
  EXPECT_EQ(fault("remove: pit", "remove: pitt"),
            "22: stage 'dig': remove: the mesh has no region 'pitt'; it has all, bank, pit, rest");
  EXPECT_EQ(fault("place: bank,", "place: bank, remove: pit,"),
            "24: stage 'bank': remove: 'pit' was removed in an earlier stage, or in this one");
  EXPECT_EQ(
      fault("place: bank,", "place: [bank, pit],"),
      "24: stage 'bank': place: 'pit' was removed in an earlier stage and does not come back; give the fill "
      "elements and a region of its own");
  EXPECT_EQ(
      fault("end: [strut, water]", "end: struts"),
      "24: stage 'bank': end: no item of 'boundary' or 'body' that has begun has the name 'struts'; there are side, strut, "
      "water");
  EXPECT_EQ(fault("{name: wet, count: 2", "{name: dig, count: 2"),
            "23: stage 'dig': name: an earlier stage is called 'dig' too");
  const std::string loose =
      fault("remove: pit", "remove: pit, end: strut, boundary: [{on: wall, tie: right}]");
  EXPECT_EQ(loose.substr(0, 60), "22: stage 'dig': boundary item 1: tie: sides are tied from t");
}

// 9 m below the surface: the ratio 1 of the region, though the item of all ground is written behind it.
TEST_F(StagesCase, takes_the_initial_stress_of_a_region_before_that_of_all_ground) {
  const Case the_case =
      read("K0: 0.6}]", "K0: 1, region: rest}, {surface: 10 m, unit_weight: 18 kN/m3, K0: 0.6}]");
  ASSERT_EQ(the_case.problem.initial_stresses.size(), 2U);
  const auto& last = the_case.problem.initial_stresses.back();
  EXPECT_EQ(last.region, "rest");
  EXPECT_DOUBLE_EQ(last.stress({1.0, 1.0})(k11), -9.0 * 18e3);
}

TEST_F(StagesCase, finds_a_stage_that_leaves_a_body_unheld) {
  // Without its base the ground slides down between the walls.
  std::string found = fault("{name: pull, count: 5, boundary: [{on: right, move: {u1: 2 mm}, name: side}]}",
                            "{name: pull, count: 5, remove: rest}");
  EXPECT_EQ(found.substr(0, 47), "25: stage 'pull': the supports of this stage le") << found;
}

TEST_F(StagesCase, finds_a_load_on_a_boundary_that_is_not_there_yet) {
  const std::string found =
      fault("{name: rest, count: 2}", "{name: rest, count: 2, boundary: [{on: floor, pressure: 20 kPa}]}");
  EXPECT_EQ(found.substr(0, 70), "21: stage 'rest': the load on 'floor' begins here, where 'floor' is no")
      << found;
}

TEST_F(StagesCase, finds_a_pressure_on_ground_that_is_yet_to_be_dug) {
  const std::string floor = "  - {on: bottom, fix: [u2]}\n  - {on: floor, ";
  const std::string found = fault("  - {on: bottom, fix: [u2]}\n", floor + "pressure: 20 kPa}\n");
  EXPECT_EQ(found.substr(0, 67), "13: boundary: the pressure on 'floor' has ground on both sides at (")
      << found;
  EXPECT_NE(found.find("let it begin in the stage that removes one side, or give 'traction'"),
            std::string::npos);
  EXPECT_EQ(fault("  - {on: bottom, fix: [u2]}\n", floor + "traction: {u2: -20 kPa}}\n"), "no fault");
  // The pit is dug from time 1 on.
  const auto with_table = [&](const std::string& table) {
    return fault("  - {on: bottom, fix: [u2]}\n", floor + "pressure: " + table + "}\n");
  };
  EXPECT_EQ(with_table("[[0, 0], [1, 0], [2, 20 kPa]]"), "no fault");
  for (const std::string table : {"[[0, 0], [0.9, 0], [2, 20 kPa]]", "[[0, 0], [0.5, 1 kPa], [1, 0]]"})
    EXPECT_EQ(with_table(table).substr(0, 30), "13: boundary: the pressure on ") << table;
}

TEST_F(StagesCase, finds_a_line_that_ends_between_corners) {
  const std::string end = "; let it end at corners";
  EXPECT_EQ(fault("wall: [4 m, 6 m,", "wall: [4 m, 6.5 m,"),
            "8: mesh.rectangle.lines: wall: it ends between two corners of elements" + end);
  EXPECT_NE(fault("wall: [4 m, 6 m,", "wall: [4 m, 6.2 m,").find(end), std::string::npos);
  EXPECT_NE(fault("floor: [0, 6 m, 4 m, 6 m]", "floor: [0, 6 m, 3 m, 6 m]").find(end), std::string::npos);
  EXPECT_EQ(fault("wall: [4 m, 6 m,", "wall: [4 m, 7 m,"), "no fault");
}

TEST_F(StagesCase, of_the_old_kind_are_read_as_ever) {
  const Case old = read(kCase.substr(kCase.find("    - {name: rest")),
                        "    - {until: 1, count: 2}\n    - {until: 2, count: 4}\n");
  EXPECT_TRUE(old.stages.empty());
  EXPECT_TRUE(old.problem.stages.empty());
  EXPECT_EQ(old.plan.size(), 6U);
  EXPECT_EQ(old.plan[2].released, 1.0);
}

}  // namespace
}  // namespace polargrain::coupler
