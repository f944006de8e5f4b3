// SPDX-License-Identifier: GPL-2.0-or-later
// Walls, their interfaces and anchors in stages of construction, against superposition, ground at rest and closed forms.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/error.hpp"
#include "common/memory_archive.hpp"
#include "coupler/case/case.hpp"
#include "coupler/case/structure_values.hpp"
#include "fem/interface/interface.hpp"

namespace polargrain::coupler {
namespace {

/// Ground of 20 m x 10 m with a wall of beams at 4 m, from the surface down to 4 m below the pit. Its interface sticks, so that
/// everything is elastic.
std::string ground(const std::string& stages, const std::string& element = "Q8R") {
  return "title: a wall in the ground\n"
         "continuum: cauchy\n"
         "mesh:\n  element: " +
         element +
         "\n"
         "  rectangle:\n"
         "    size: [20 m, 10 m]\n"
         "    elements: [10, 10]\n"
         "    regions: {p1: [0, 9 m, 4 m, 10 m], p2: [0, 8 m, 4 m, 9 m], p3: [0, 7 m, 4 m, 8 m],"
         " p4: [0, 6 m, 4 m, 7 m], p5: [0, 5 m, 4 m, 6 m]}\n"
         "    lines: {line: [4 m, 1 m, 4 m, 10 m]}\n"
         "materials: {soil: {model: elastic, E: 20 MPa, nu: 0.3}}\n"
         "regions: {p1: soil, p2: soil, p3: soil, p4: soil, p5: soil, rest: soil}\n"
         "interfaces: {skin: {on: line, friction: 45 deg, cohesion: 1 GPa, tension: 0.9 GPa, "
         "cohesion_after_opening: kept, normal_stiffness: 1 GPa/m, shear_stiffness: 0.1 GPa/m}}\n"
         "beams: {wall: {on: line, EA: 3000 MN/m, EI: 20 MNm2/m}}\n"
         "anchors: {rod: {from: wall_top, to: [14 m, 6 m], EA: 20 MN/m, prestress: 40 kN/m}}\n"
         "boundary:\n"
         "  - {on: [left, right], fix: [u1]}\n"
         "  - {on: bottom, fix: [u1, u2]}\n"
         "body: [{unit_weight: 18 kN/m3}]\n"
         "initial_stress: [{surface: 10 m, unit_weight: 18 kN/m3, K0: 0.6}]\n"
         "steps:\n"
         "  tolerance: 1e-13\n"
         "  stages:\n" +
         stages;
}

Case read(const std::string& text) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("structure_stages." + std::to_string(getpid()) + ".yaml");
  std::ofstream(file) << text;
  Case the_case = read_case(file);
  std::filesystem::remove(file);
  for (auto& [region, material] : the_case.problem.materials)
    material = the_case.materials.at(the_case.regions.at(region))->make_for<2>(nullptr);
  return the_case;
}

void take(const Case& the_case, int step, fem::Solver<2>& solver) {
  const CaseStage* const stage = the_case.stage_of(step);
  if (stage != nullptr && stage->first_step == step && stage->number != solver.state().stage)
    solver.begin_stage(stage->number);
  const StepTarget& target = the_case.plan[static_cast<std::size_t>(step) - 1];
  const fem::StepReport report = solver.advance(target.amount, target.released);
  ASSERT_TRUE(report.converged) << "step " << step << ": " << report.message;
}

/// @param steps that are taken; 0: all
std::unique_ptr<fem::Solver<2>> run(const Case& the_case, int steps = 0) {
  auto solver = std::make_unique<fem::Solver<2>>(the_case.problem, the_case.solver);
  const fem::StepReport begun = solver->equilibrate();
  EXPECT_TRUE(begun.converged) << begun.message;
  for (int step = 1; step <= (steps > 0 ? steps : the_case.steps()); ++step) take(the_case, step, *solver);
  return solver;
}

double value(const fem::Solver<2>& solver, const std::string& name, const std::string& of) {
  return value_of_structure(solver.problem(), name, of);
}

double largest(const Eigen::VectorXd& values) {
  return values.lpNorm<Eigen::Infinity>();
}

constexpr const char* kPlace = "    - {name: wall, place: [wall, rod], count: 2}\n";
constexpr const char* kOneCut = "    - {name: dig, remove: [p1, p2, p3, p4, p5], count: 1}\n";
constexpr const char* kFiveCuts =
    "    - {name: d1, remove: p1, count: 1}\n"
    "    - {name: d2, remove: p2, count: 3}\n"
    "    - {name: d3, remove: p3, count: 1}\n"
    "    - {name: d4, remove: p4, count: 2}\n"
    "    - {name: d5, remove: p5, count: 1}\n";

// All is linear, so how the pit is dug does not matter.
TEST(StructureStages, FiveCutsAreOneCut) {
  for (const std::string before : {"", kPlace}) {
    for (const std::string element : {"Q8R", "Q4", "T6"}) {
      const auto one = run(read(ground(before + kOneCut, element)));
      const auto five = run(read(ground(before + kFiveCuts, element)));
      // Nodes that are gone keep their last value.
      const std::vector<char> left = fem::nodes_of_elements(
          one->problem().mesh, fem::elements_in_stage(one->problem(), one->state().stage));
      double difference = 0.0;
      for (std::size_t node = 0; node < left.size(); ++node) {
        const auto first = static_cast<Eigen::Index>(fem::entry_of<2>(node, fem::Dof::u1));
        if (left[node] != 0)
          difference = std::max(difference, largest(one->state().displacement.segment<2>(first) -
                                                    five->state().displacement.segment<2>(first)));
      }
      EXPECT_LT(difference, 1e-9 * largest(one->state().displacement)) << before << element;
      for (const auto& [name, of] : std::vector<std::pair<std::string, std::string>>{
               {"wall", "moment"}, {"wall", "shear"}, {"rod", "force"}, {"skin right", "pressure"}})
        EXPECT_NEAR(value(*five, name, of) / value(*one, name, of), 1.0, 1e-9) << name << element;
      EXPECT_GT(std::abs(value(*one, "wall", "moment")), 1e3);
    }
  }
}

// Placed where the ground has sunk by 18 mm, then drawn without bending: EA strain, and moments that are rounding alone.
TEST(StructureStages, APlateInMovedGroundTakesPureTension) {
  const Case the_case = read(
      "title: a plate in ground that has moved\n"
      "continuum: cauchy\n"
      "mesh: {rectangle: {size: [4 m, 1 m], elements: [8, 2], lines: {mid: [0, 0.5 m, 4 m, 0.5 m]}}}\n"
      "materials: {soil: {model: elastic, E: 20 MPa, nu: 0}}\n"
      "regions: {all: soil}\n"
      "beams: {plate: {on: mid, EA: 200 MN/m, EI: 2 MNm2/m}}\n"
      "boundary:\n"
      "  - {on: left, fix: [u1, u2]}\n"
      "  - {on: plate_left, fix: [w]}\n"
      "  - {on: right, move: {u1: [[0, 0], [1, 0], [2, 1 mm]]}}\n"
      "  - {on: right, traction: {u1: 0, u2: [[0, 0], [1, -5 kPa]]}}\n"
      "steps: {stages: [{name: load, until: 1, count: 1}, {name: more, place: plate, until: 2, count: 1}]}\n");
  const auto solver = run(the_case);
  EXPECT_LT(solver->mean_displacement("right")(1), -0.018);
  EXPECT_NEAR(value(*solver, "plate", "axial"), 200e6 * 1e-3 / 4.0, 1e-3);
  EXPECT_NEAR(value(*solver, "plate", "moment"), 0.0, 1e-3);
}

// What the tolerance has left in the cut is nothing that the slab changes, and a slab that comes free of forces changes nothing.
TEST(StructureStages, OnlyWhatAStageChangesIsHeldAgainstTheTolerance) {
  const Case the_case = read(
      "title: a slab below a cut\n"
      "continuum: cauchy\n"
      "mesh: {rectangle: {size: [24 m, 9 m], elements: [24, 9], regions: {pit: [0, 6 m, 6 m, 9 m]}, "
      "lines: {low: [10 m, 6 m, 20 m, 6 m]}}}\n"
      "materials:\n"
      "  soil: {model: elastoplastic, E: 40 MPa, nu: 0.3, friction_angle: 20 deg, dilatancy_angle: 0 deg, "
      "cohesion: 20 kPa}\n"
      "regions: {pit: soil, rest: soil}\n"
      "beams: {slab: {on: low, EA: 100 MN/m, EI: 1 MNm2/m}}\n"
      "boundary: [{on: [left, right], fix: [u1]}, {on: bottom, fix: [u1, u2]}]\n"
      "body: [{unit_weight: 18 kN/m3}]\n"
      "initial_stress: [{surface: 9 m, unit_weight: 18 kN/m3, K0: 0.6}]\n"
      "steps: {tolerance: 1e-4, stages: [{name: cut, remove: pit, count: 5}, {name: slab, place: slab, count: 1}]}\n");
  fem::Solver<2> solver(the_case.problem, the_case.solver);
  ASSERT_TRUE(solver.equilibrate().converged);
  for (int step = 1; step <= the_case.steps(); ++step) {
    const CaseStage& stage = *the_case.stage_of(step);
    if (stage.first_step == step) {
      if (stage.number != solver.state().stage) solver.begin_stage(stage.number);
      const double share = solver.tolerated_share_of_change();
      EXPECT_NEAR(share, stage.name == "cut" ? 3e-3 : 0.0, 1e-4) << stage.name;
    }
    take(the_case, step, solver);
  }
}

// A wall that a stage cuts into ground at rest carries the stress that was there, and nothing moves.
TEST(StructureStages, GroundAtRestStaysAtRestWhenAWallIsPlaced) {
  const Case the_case =
      read(ground("    - {name: wall, place: wall, count: 2}\n"
                  "    - {name: rod, place: rod, count: 1}\n"));
  const auto solver = run(the_case, 2);
  EXPECT_LT(largest(solver->state().displacement), 1e-12);
  EXPECT_NEAR(value(*solver, "wall", "moment"), 0.0, 1e-6);
  int found = 0;
  for (const auto& contribution : solver->problem().contributions) {
    const auto* const skin = dynamic_cast<const fem::Interface<2>*>(contribution.get());
    if (skin == nullptr) continue;
    for (const fem::InterfacePointResult<2>& point : skin->results()) {
      if (point.geometry.place(1) < 1.1) continue;  // the toe has the stress of its neighbour
      EXPECT_NEAR(point.traction(1), -0.6 * 18e3 * (10.0 - point.geometry.place(1)), 1e-5);
      EXPECT_NEAR(point.traction(0), 0.0, 1e-5);
      ++found;
    }
  }
  EXPECT_EQ(found, 2 * (9 * 3 - 1));
  EXPECT_EQ(value(*solver, "rod", "force"), 0.0);
}

// A rigid wall, a beam and a joint of the ground that are there from the start. With undrained ground a wall that began without
// stress would keep 37 of 40 kPa.
TEST(StructureStages, WhatIsThereFromTheStartCarriesTheGround) {
  const auto with_wall = [](const std::string& wall, const std::string& water, const std::string& element) {
    return "title: a wall from the start\n"
           "continuum: cauchy\n"
           "mesh: {element: " +
           element +
           ", rectangle: {size: [4 m, 4 m], elements: [4, 8], regions: {near: [0, 0, 2 m, 4 m]}, "
           "lines: {line: [2 m, 0, 2 m, 4 m]}}}\n"
           "materials: {clay: {model: elastic, E: 10 MPa, nu: 0.25}}\n"
           "regions: {near: clay, rest: clay}\n" +
           wall + water +
           "body: [{unit_weight: 20 kN/m3}]\n"
           "initial_stress: [{surface: 4 m, unit_weight: 20 kN/m3, K0: 0.5}]\n"
           "steps: {count: 1, tolerance: 1e-9" +
           (water.empty() ? "" : ", duration: 1 d") + "}\n";
  };
  const std::string rigid =
      "interfaces: {wall: {on: left, friction: 20 deg}}\n"
      "boundary:\n  - {on: wall, fix: [u1, u2]}\n  - {on: right, fix: [u1]}\n  - {on: bottom, fix: [u1, u2]}\n";
  const std::string joint =
      "interfaces: {wall: {on: line, friction: 20 deg}}\n"
      "boundary:\n  - {on: [left, right], fix: [u1]}\n  - {on: bottom, fix: [u2]}\n";
  for (const std::string& wall : {rigid, joint})
    for (const std::string water : {"", "water: {undrained: true, level: 4 m, unit_weight: 10 kN/m3}\n"})
      for (const std::string element : {"Q8R", "Q4", "T6"}) {
        if (!water.empty() && element == "Q4") continue;  // pore pressures need the others
        const auto solver = run(read(with_wall(wall, water, element)));
        const double weight = water.empty() ? 20e3 : 10e3;  // of the grains in the water
        const double pressure = 0.5 * weight * 4.0 * 4.0 / 2.0;
        // Forces at the nodes of linear sides are not those of a stress that grows along them.
        const bool is_linear = element == "Q4";
        EXPECT_NEAR(value(*solver, "wall", "pressure") / pressure, 1.0, is_linear ? 0.01 : 1e-6)
            << wall << water << element;
        const auto nodes = static_cast<Eigen::Index>(solver->problem().mesh.nodes.size());
        EXPECT_LT(largest(solver->state().displacement.head(3 * nodes)), is_linear ? 2e-5 : 1e-9)
            << wall << water << element;
      }
}

// Before it is placed the wall is not felt: the ground is one body, as it is without any.
TEST(StructureStages, GroundIsOneBodyUntilTheWallComes) {
  const std::string dig =
      "    - {name: dig, remove: p1, count: 1}\n    - {name: wall, place: [wall, rod], count: 1}\n";
  const auto with = run(read(ground(dig)), 1);
  std::string plain = ground("    - {name: dig, remove: p1, count: 1}\n");
  for (const std::string key : {"interfaces:", "beams:", "anchors:"})
    plain.erase(plain.find(key), plain.find('\n', plain.find(key)) + 1 - plain.find(key));
  const auto without = run(read(plain));
  for (std::size_t node = 0; node < without->problem().mesh.nodes.size(); ++node) {
    const auto entry = fem::entry_of<2>(static_cast<int>(node), fem::Dof::u2);
    EXPECT_NEAR(with->state().displacement(entry), without->state().displacement(entry),
                1e-9 * largest(without->state().displacement));
  }
}

/// Of the head of the wall towards the fixed end of the rod: the rod shortens by it, m.
double along_rod(const fem::Solver<2>& solver) {
  const Eigen::Vector2d way = (Eigen::Vector2d(14, 6) - Eigen::Vector2d(4, 10)).normalized();
  const int head = solver.problem().mesh.nodes_on("wall_top").front();
  return way.dot(solver.state().displacement.segment<2>(fem::entry_of<2>(head)));
}

/// A node force on the head of the wall along the rod. @param force kN/m, towards its fixed end
std::string pull_along_rod(double force) {
  const Eigen::Vector2d way = force * (Eigen::Vector2d(14, 6) - Eigen::Vector2d(4, 10)).normalized();
  return "boundary: [{on: wall_top, node_force: {u1: " + std::to_string(way(0)) +
         " kN/m, u2: " + std::to_string(way(1)) + " kN/m}}]";
}

constexpr double kRodStiffness = 20e6 / 10.770329614269007;  // N/m per m, over the root of 116 m2
constexpr const char* kWall = "    - {name: wall, place: wall, count: 1}\n";

// The stage that places it jacks it: the ground moves as under a force of that size, and the rod is locked with it. Behind that stage
// the rod gives way and pulls as its stiffness has it.
TEST(StructureStages, ARodIsJackedWhenItComesAndLetsGoWhenItGoes) {
  for (const std::string count : {"1", "2"}) {
    const Case the_case = read(ground(kWall + ("    - {name: rod, place: rod, count: " + count + "}\n") +
                                      "    - {name: dig, remove: p1, count: 2}\n"
                                      "    - {name: gone, remove: rod, count: 1}\n"));
    const int jacked_at = 1 + std::stoi(count);
    const auto jacked = run(the_case, jacked_at);
    EXPECT_NEAR(value(*jacked, "rod", "force"), 40e3, 40e3 * 1e-9);
    const auto loaded =
        run(read(ground(kWall + ("    - {name: pull, count: 1, " + pull_along_rod(40.0) + "}\n") +
                        "    - {name: rod, place: rod, count: 1}\n")),
            2);
    EXPECT_NEAR(along_rod(*jacked) / along_rod(*loaded), 1.0, 1e-6);  // digits of the text of the force
    const double before = along_rod(*jacked);
    const auto dug = run(the_case, jacked_at + 2);
    const double elongation = before - along_rod(*dug);
    EXPECT_GT(std::abs(elongation), 1e-6);
    EXPECT_NEAR(value(*dug, "rod", "force"), 40e3 + kRodStiffness * elongation, 40e3 * 1e-7);
    const auto gone = run(the_case);
    EXPECT_EQ(value(*gone, "rod", "force"), 0.0);
    const auto never = run(read(ground(kWall + std::string("    - {name: dig, remove: p1, count: 2}\n"
                                                           "    - {name: rod, place: rod, count: 1}\n"))),
                           3);
    EXPECT_NEAR(along_rod(*gone), along_rod(*never), 1e-9 * largest(never->state().displacement));
  }
}

// Under a load of the stage that places it a jacked rod has its prestress all the same. A rod without a prestress resists that load
// from the beginning.
TEST(StructureStages, ALoadOfTheStageThatPlacesARodStretchesOnlyRodsWithoutPrestress) {
  const std::string loaded = "    - {name: rod, place: rod, count: 2, " + pull_along_rod(-40.0) + "}\n";
  const auto jacked = run(read(ground(kWall + loaded)));
  EXPECT_NEAR(value(*jacked, "rod", "force"), 40e3, 40e3 * 1e-9);
  std::string text = ground(kWall + loaded);
  const std::string prestress = ", prestress: 40 kN/m";
  text.erase(text.find(prestress), prestress.size());
  const auto plain = run(read(text));
  EXPECT_LT(along_rod(*plain), 0.0);
  EXPECT_NEAR(value(*plain, "rod", "force"), -kRodStiffness * along_rod(*plain), 40e3 * 1e-7);
}

// Locked too where the stage behind names no change: a load that grows by a table stretches it.
TEST(StructureStages, ARodIsLockedBeforeAStageThatNamesNoChange) {
  std::string text = ground(kWall + std::string("    - {name: rod, place: rod, count: 1}\n"
                                                "    - {name: load, count: 2}\n"
                                                "    - {name: more, count: 1}\n"));
  const std::string bottom = "  - {on: bottom, fix: [u1, u2]}\n";
  text.replace(text.find(bottom), bottom.size(),
               bottom + "  - {on: wall_top, node_force: {u1: [[0, 0], [2, 0], [5, -40 kN/m]]}}\n");
  const auto jacked = run(read(text), 2);
  EXPECT_NEAR(value(*jacked, "rod", "force"), 40e3, 40e3 * 1e-9);
  for (const int steps : {4, 5}) {
    const auto loaded = run(read(text), steps);
    const double elongation = along_rod(*jacked) - along_rod(*loaded);
    EXPECT_GT(elongation, 1e-5);
    EXPECT_NEAR(value(*loaded, "rod", "force"), 40e3 + kRodStiffness * elongation, 40e3 * 1e-7);
  }
}

// The nodes of a wall belong to no element of the ground, and carry loads all the same where ground has gone.
TEST(StructureStages, AForceMovesAWallWhoseGroundWasDugAway) {
  const auto head = [](const std::string& force) {
    const auto solver =
        run(read(ground(std::string(kPlace) + kOneCut + "    - {name: push, count: 1" + force + "}\n")));
    return solver->mean_displacement("wall_top")(0);
  };
  const auto push = [](const std::string& size) {
    return ", boundary: [{on: wall_top, node_force: {u1: " + size + " kN/m}}]";
  };
  const double still = head("");
  const double once = head(push("20")) - still;
  EXPECT_GT(once, 1e-3);
  EXPECT_NEAR((head(push("40")) - still) / once, 2.0, 1e-6);
}

// The state of a stage with a wall that has come is kept in a checkpoint.
TEST(StructureStages, AreRestoredInTheMiddleOfAStage) {
  const Case the_case = read(ground(kPlace + std::string(kFiveCuts)));
  const auto whole = run(the_case);
  const double moment = value(*whole, "wall", "moment");
  const double pull = value(*whole, "rod", "force");
  const Eigen::VectorXd displacement = whole->state().displacement;
  for (const int middle : {1, 2, 4, 7}) {
    const auto first = run(the_case, middle);
    MemoryArchive archive;
    first->save(archive);
    const Case again = read(ground(kPlace + std::string(kFiveCuts)));
    fem::Solver<2> second(again.problem, again.solver);
    second.restore(archive);
    for (int step = middle + 1; step <= again.steps(); ++step) take(again, step, second);
    EXPECT_EQ(second.state().displacement, displacement) << middle;
    EXPECT_EQ(value(second, "wall", "moment"), moment);
    EXPECT_EQ(value(second, "rod", "force"), pull);
  }
}

// Fill that is placed beside a wall has its interface from then on, and its weight goes to the base.
TEST(StructureStages, FillHasTheInterfaceOfTheWallThatItIsPlacedAgainst) {
  std::string text = ground(
      "    - {name: strip, remove: p1, count: 1}\n"
      "    - {name: fill, place: fill, count: 3}\n");
  const std::string region = "p1: [0, 9 m, 4 m, 10 m]";
  text.replace(text.find(region), region.size(), "p1: [0, 9 m, 2 m, 10 m], fill: [2 m, 9 m, 4 m, 10 m]");
  const std::string regions = "regions: {p1: soil";
  text.replace(text.rfind(regions), regions.size(), "regions: {fill: soil, p1: soil");
  const std::string initial = "initial_stress: [{surface: 10 m, unit_weight: 18 kN/m3, K0: 0.6}]\n";
  std::string given = "initial_stress:\n";
  for (const std::string name : {"p1", "p2", "p3", "p4", "p5", "rest"})
    given += "  - {surface: 10 m, unit_weight: 18 kN/m3, K0: 0.6, region: " + name + "}\n";
  text.replace(text.find(initial), initial.size(), given);
  text.erase(text.find("anchors:"), text.find('\n', text.find("anchors:")) + 1 - text.find("anchors:"));
  const auto before = run(read(text), 1);
  const auto after = run(read(text));
  const auto top_pressure = [](const fem::Solver<2>& solver) {
    double pressure = 0.0;
    for (const auto& contribution : solver.problem().contributions) {
      const auto* const skin = dynamic_cast<const fem::Interface<2>*>(contribution.get());
      if (skin == nullptr || skin->settings().name != "skin left") continue;
      for (const fem::InterfacePointResult<2>& point : skin->results())
        if (point.geometry.place(1) > 9.01) pressure -= point.geometry.area * point.traction(1);
    }
    return pressure;
  };
  EXPECT_EQ(top_pressure(*before), 0.0);             // its faces are not there
  EXPECT_GT(std::abs(top_pressure(*after)), 0.1e3);  // they are, and the fill sticks to the wall
  // What the ground and the wall stand on has grown by the weight.
  EXPECT_NEAR(after->reaction("bottom")(1) - before->reaction("bottom")(1), 36e3, 1.0);
}

std::string fault_of(const std::string& stages, const std::string& from = "from: wall_top") {
  std::string text = ground(stages);
  text.replace(text.find("from: wall_top"), std::string("from: wall_top").size(), from);
  try {
    (void)read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(StructureStages, FaultsNameThePartAndTheRemedy) {
  EXPECT_NE(fault_of("    - {name: x, place: wal, count: 1}\n")
                .find("beams, interfaces and anchors are rod, skin, wall"),
            std::string::npos);
  EXPECT_NE(fault_of("    - {name: x, remove: skin, count: 1}\n").find("goes with the ground beside it"),
            std::string::npos);
  EXPECT_NE(fault_of("    - {name: x, place: wall, count: 1}\n    - {name: y, place: wall, count: 1}\n")
                .find("'wall' has been placed in an earlier stage"),
            std::string::npos);
  // An anchor at a node of ground that goes.
  const std::string at_corner = fault_of("    - {name: cut, remove: p1, count: 1}\n", "from: top_left");
  EXPECT_NE(at_corner.find(
                "stage 'cut': the anchor 'rod' ends at (0, 10), where the ground is not there; 'remove' the "
                "anchor too"),
            std::string::npos)
      << at_corner;
  EXPECT_EQ(fault_of("    - {name: cut, remove: [p1, rod], count: 1}\n", "from: top_left"), "");
}

}  // namespace
}  // namespace polargrain::coupler
