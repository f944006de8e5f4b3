// SPDX-License-Identifier: GPL-2.0-or-later
// Walls with ground on one side of a part of them, and walls that meet, against mirror images, statics and closed forms.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fem/beam/beam.hpp"
#include "tests/support/case_of_laws.hpp"

using polargrain::testing::RunOfLaws;

namespace {

// Forces are in balance to this share.
constexpr double kBalanced = 1e-10;

/// A strutted wall beside a pit that has been dug before: no ground left of its upper part, or, mirrored, right of it.
std::string dug_before(bool mirrored,
                       const std::string& interface = "skin: {on: wall, friction: 20 deg, cohesion: 2 kPa}") {
  return "title: A wall at a pit that has been dug\n"
         "continuum: cauchy\n" +
         std::string(
             mirrored
                 ? "mesh: {rectangle: {size: [12 m, 8 m], elements: [6, 4], regions: {void: [8 m, 4 m, 12 m, 8 m]}, "
                   "lines: {wall: [8 m, 2 m, 8 m, 8 m]}}}\n"
                 : "mesh: {rectangle: {size: [12 m, 8 m], elements: [6, 4], regions: {void: [0, 4 m, 4 m, 8 m]}, "
                   "lines: {wall: [4 m, 2 m, 4 m, 8 m]}}}\n") +
         "materials: {soil: {model: elastic, E: 20 MPa, nu: 0.3}}\n"
         "regions: {rest: soil}\n" +
         (interface.empty() ? "" : "interfaces: {" + interface + "}\n") +
         "beams: {sheet: {on: wall, EA: 3000 MN/m, EI: 40 MNm2/m}}\n" +
         fmt::format("anchors: {{strut: {{from: sheet_top, to: [{} m, 8 m], EA: 200 MN/m}}}}\n",
                     mirrored ? 14 : -2) +
         "boundary:\n"
         "  - {on: [left, right], fix: [u1]}\n"
         "  - {on: bottom, fix: [u1, u2]}\n"
         "body: [{unit_weight: 18 kN/m3, factor: [[0, 0], [1, 1]]}]\n" +
         fmt::format("steps: {{count: 4, tolerance: {}}}\n", kBalanced);
}

std::string monitors_of(const std::string& ground, const std::string& pit) {
  return fmt::format(
      "monitors: {{p: {{interface: skin {0}, value: pressure}}, s: {{interface: skin {0}, value: shear}}, "
      "lever: {{interface: skin {0}, value: lever}}, passive: {{interface: skin {1}, value: pressure}}, "
      "moment: {{beam: sheet, value: moment}}, strut: {{anchor: strut}}}}\n",
      ground, pit);
}

TEST(WallsThatMeet, AMirroredPitHasTheSameFigures) {
  const RunOfLaws dug(dug_before(false) + monitors_of("right", "left"));
  const RunOfLaws mirrored(dug_before(true) + monitors_of("left", "right"));
  for (const std::string name : {"p", "s", "lever", "passive", "moment", "strut"})
    EXPECT_NEAR(std::abs(dug.last(name) / mirrored.last(name)), 1.0, 10.0 * kBalanced) << name;
  // Nothing else pushes the wall along x1: the strut is in compression.
  EXPECT_NEAR(dug.last("p") - dug.last("passive") + dug.last("strut"), 0.0, 10.0 * kBalanced * dug.last("p"));
}

// Beams go one way, welded too: where two elements meet they have one moment.
TEST(WallsThatMeet, BesideGroundOnOneSideABeamGoesOneWay) {
  for (const std::string interface : {"", "skin: {on: wall, friction: 20 deg}"}) {
    const auto the_case = polargrain::testing::case_of(dug_before(false, interface));
    for (const auto& contribution : the_case.problem.contributions) {
      const auto* const beam = dynamic_cast<const polargrain::fem::Beam*>(contribution.get());
      if (beam == nullptr) continue;
      const auto results = beam->results(the_case.problem);
      ASSERT_EQ(results.size(), 6U);
      for (std::size_t k = 2; k < results.size(); k += 2)
        EXPECT_EQ(results[k].place, results[k - 1].place) << interface << k;
    }
  }
}

// The pit is full up to 2 m, the ground behind up to 3 m, and held all over: the foot has gw (27 - 8) / 6 of hydrostatic pressures.
TEST(WallsThatMeet, FreeWaterPressesWhereNoGroundWas) {
  constexpr double weight = 10e3;  // N/m3
  const RunOfLaws run(
      "title: Water in a pit\n"
      "continuum: cauchy\n"
      "mesh: {rectangle: {size: [4 m, 3 m], elements: [4, 3], regions: {void: [0, 1 m, 2 m, 3 m]}, "
      "lines: {line: [2 m, 0 m, 2 m, 3 m]}}}\n"
      "materials: {sand: {model: elastic, E: 20 MPa, nu: 0.3}}\n"
      "regions: {rest: sand}\n"
      "water: {unit_weight: 10 kN/m3, permeability: 1e-4 m/s, level: 3 m}\n"
      "interfaces: {skin: {on: line, friction: 0 deg, normal_stiffness: 1e-3 Pa/m, shear_stiffness: 1e-3 Pa/m, "
      "water: impervious}}\n"
      "beams: {sheet: {on: line, EA: 3000 MN/m, EI: 20 MNm2/m, clamped: sheet_bottom}}\n"
      "boundary:\n"
      "  - {on: all, fix: [u1, u2]}\n"
      "  - {on: sheet, fix: [u2]}\n"
      "  - {on: sheet_bottom, fix: [u1, u2]}\n"
      "  - {on: left, water_level: 2 m}\n"
      "  - {on: right, water_level: 3 m}\n"
      "  - {on: sheet, free_water: 2 m}\n"
      "steps: {duration: 2 a, count: 2, tolerance: 1e-9}\n"
      "monitors: {moment: {beam: sheet, value: moment}, left: {interface: skin left, value: water}, "
      "right: {interface: skin right, value: water}}\n");
  EXPECT_NEAR(run.last("left"), weight * 1.5, 1e-7 * weight);
  EXPECT_NEAR(run.last("right"), weight * 4.5, 1e-7 * weight);
  EXPECT_NEAR(std::abs(run.last("moment")), weight * 19.0 / 6.0, 1e-7 * weight);
}

/// The same pit, mirrored, with a slab on its floor. @param interface of the slab; empty: it is welded to the ground
std::string with_slab(const std::string& interface, const std::string& more) {
  std::string text = dug_before(true, "skin: {on: wall, friction: 20 deg, cohesion: 2 kPa}" + interface);
  const auto insert = [&](const std::string& before, const std::string& added) {
    text.insert(text.find(before), added);
  };
  insert("}}}\nmaterials", ", floor: [8 m, 4 m, 12 m, 4 m]");
  insert("}\nanchors", ", slab: {on: floor, EA: 15000 MN/m, EI: 312 MNm2/m, clamped: [slab_right]}");
  insert("  - {on: bottom", "  - {on: slab_right, fix: [u1]}\n");
  return text + more;
}

// Without friction below it the slab's axial force is one all along: the wall hands it on what strut and ground leave.
TEST(WallsThatMeet, ASlabPropsTheWallThatItEndsAt) {
  const RunOfLaws run(with_slab(", under: {on: floor, friction: 0 deg}",
                                "monitors: {p: {interface: skin left, value: pressure}, "
                                "passive: {interface: skin right, value: pressure}, strut: {anchor: strut}, "
                                "slab: {beam: slab, value: axial}}\n"));
  const double p = run.last("p");
  EXPECT_GT(std::abs(run.last("slab")), 0.01 * p);
  EXPECT_NEAR(p - run.last("passive") + run.last("strut") + run.last("slab"), 0.0, 10.0 * kBalanced * p);
}

TEST(WallsThatMeet, BeamsShareANodeThatIsTheWalls) {
  for (const std::string interface : {"", ", under: {on: floor, friction: 0 deg}"}) {
    const auto the_case = polargrain::testing::case_of(with_slab(interface, ""));
    const std::vector<int> wall = the_case.problem.mesh.nodes_on("sheet");
    const std::vector<int> end = the_case.problem.mesh.nodes_on("slab_left");
    ASSERT_EQ(end.size(), 1U);
    EXPECT_EQ(std::ranges::count(wall, end.front()), 1) << interface;
  }
}

// Until the slab comes the ground hangs together there, and does not hang on the wall that stands.
TEST(WallsThatMeet, AWallThatStandsDoesNotHoldTheGroundForOneThatComes) {
  const auto the_case = polargrain::testing::case_of(
      "title: A slab that comes\n"
      "continuum: cauchy\n"
      "mesh: {rectangle: {size: [4 m, 4 m], elements: [4, 4], regions: {pit: [2 m, 2 m, 4 m, 4 m]}, "
      "lines: {wall: [2 m, 1 m, 2 m, 4 m], floor: [2 m, 2 m, 4 m, 2 m]}}}\n"
      "materials: {soil: {model: elastic, E: 20 MPa, nu: 0.3}}\n"
      "regions: {pit: soil, rest: soil}\n"
      "interfaces: {skin: {on: wall, friction: 20 deg}, under: {on: floor, friction: 20 deg}}\n"
      "beams: {sheet: {on: wall, EA: 3000 MN/m, EI: 40 MNm2/m}, slab: {on: floor, EA: 3000 MN/m, EI: 40 MNm2/m}}\n"
      "boundary:\n"
      "  - {on: [left, right], fix: [u1]}\n"
      "  - {on: bottom, fix: [u1, u2]}\n"
      "steps: {tolerance: 1e-8, stages: [{name: dig, remove: pit, count: 1}, {name: slab, place: slab, count: 1}]}\n");
  const int shared = the_case.problem.mesh.nodes_on("slab_left").front();
  int on_the_wall = 0;
  int across = 0;
  for (const auto& contribution : the_case.problem.contributions)
    for (const auto& [one, other] : contribution->tied_nodes(0)) {
      on_the_wall += one == shared || other == shared ? 1 : 0;
      const auto& place = the_case.problem.mesh.nodes[static_cast<std::size_t>(shared)];
      across += the_case.problem.mesh.nodes[static_cast<std::size_t>(one)] == place ? 1 : 0;
    }
  EXPECT_EQ(on_the_wall, 0);
  EXPECT_EQ(across, 1) << "the ground above and below";
}

}  // namespace
