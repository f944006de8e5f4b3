// SPDX-License-Identifier: GPL-2.0-or-later
// Pore water in a case: what it makes of the problem, and faults with line and remedy.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "common/error.hpp"
#include "coupler/case/case.hpp"
#include "fem/water/pore_water.hpp"

namespace polargrain::coupler {
namespace {

// The lines of a good case, one of which a test replaces.
const std::vector<std::pair<std::string, std::string>> kGood{
    {"mesh",
     "mesh: {rectangle: {size: [2 m, 2 m], elements: [2, 4], levels: {odd: 0.25 m}, regions: {low: [0, 0, "
     "2 m, 1 m]}}}"},
    {"materials", "materials: {ground: {model: elastic, E: 10 MPa, nu: 0.3, Gc: 2 MPa, lc: 10 mm}}"},
    {"regions", "regions: {rest: ground, low: ground}"},
    {"water", "water: {permeability: 1e-5 m/s, level: 2 m}"},
    {"boundary", "boundary: [{on: bottom, fix: [u1, u2]}, {on: top, drained: true}]"},
    {"steps", "steps: {duration: 1 d, count: 2}"},
    {"monitors", "monitors: {p: {on: bottom, water: pressure}}"}};

Case wet_case(const std::vector<std::pair<std::string, std::string>>& changes) {
  std::string text = "title: a block\n";
  for (const auto& [key, line] : kGood) {
    std::string taken = line;
    for (const auto& [changed, replacement] : changes)
      if (changed == key) taken = replacement;
    text += taken + "\n";
  }
  for (const auto& [key, line] : changes)
    if (key.empty()) text += line + "\n";
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("water_faults." + std::to_string(getpid()) + ".yaml");
  std::ofstream(file) << text;
  return read_case(file);
}

std::string faults_of(const std::vector<std::pair<std::string, std::string>>& changes) {
  try {
    (void)wet_case(changes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect(const std::vector<std::pair<std::string, std::string>>& changes, const std::string& part) {
  const std::string faults = faults_of(changes);
  EXPECT_NE(faults.find(part), std::string::npos) << changes.front().second << "\n" << faults;
  EXPECT_NE(faults.find("yaml:"), std::string::npos) << "a line: " << faults;
}

TEST(WaterInACase, GivesTheProblemItsPressures) {
  const Case the_case = wet_case({});
  ASSERT_EQ(the_case.problem.fields.size(), 1U);
  EXPECT_EQ(the_case.problem.fields[0].name, fem::kPorePressure);
  EXPECT_EQ(the_case.problem.fields[0].nodes.size(), 15U);  // the corners
  EXPECT_DOUBLE_EQ(the_case.problem.fields[0].initial.front(), 2.0 * 9.81e3);
  ASSERT_NE(fem::pore_water_of(the_case.problem), nullptr);
  EXPECT_EQ(fem::pore_water_of(the_case.problem)->regions().size(), 2U);
  EXPECT_DOUBLE_EQ(the_case.plan.back().amount, 86400.0);
}

TEST(WaterInACase, RegionsHaveKeysOfTheirOwn) {
  const Case the_case =
      wet_case({{"water",
                 "water: {void_ratio: 0.6, regions: {low: {permeability: {kozeny_carman: "
                 "{diameter: 0.2 mm}}, bulk_modulus: 1 GPa}}}"},
                {"boundary",
                 "boundary: [{on: bottom, fix: [u1, u2], pore_pressure: [[0 s, 0 kPa], [1 h, "
                 "5 kPa]]}, {on: left, flux: 1 mm/s}]"}});
  const auto& regions = fem::pore_water_of(the_case.problem)->regions();
  ASSERT_EQ(regions.size(), 1U);
  const fem::WaterOfRegion& low = regions.at("low");
  EXPECT_DOUBLE_EQ(low.bulk_modulus, 1e9);
  // (9.81e3 / 1e-3) (2e-4)^2 0.6^3 / (180 1.6)
  EXPECT_NEAR(low.permeability.at(0.6), 9.81e6 * 4e-8 * 0.216 / 288.0, 1e-12);
  EXPECT_DOUBLE_EQ(the_case.problem.prescribed_fields.at(0).value.at(1800.0), 2.5e3);
  EXPECT_DOUBLE_EQ(fem::pore_water_of(the_case.problem)->options().fluxes.at(0).value.at(0.0), 1e-3);
}

TEST(WaterInACase, StepsMayGrow) {
  const Case the_case = wet_case({{"steps", "steps: {duration: 10 h, count: 10, first: 1 min}"}});
  EXPECT_NEAR(the_case.plan[0].amount, 60.0, 1e-9);
  EXPECT_DOUBLE_EQ(the_case.plan[9].amount, 36000.0);
  const double ratio = (the_case.plan[1].amount - the_case.plan[0].amount) / 60.0;
  for (std::size_t k = 2; k < 10; ++k)
    EXPECT_NEAR((the_case.plan[k].amount - the_case.plan[k - 1].amount) /
                    (the_case.plan[k - 1].amount - the_case.plan[k - 2].amount),
                ratio, 1e-6);
}

TEST(WaterInACase, FaultsOfItsKeys) {
  expect({{"water", "water: {level: 2 m}"}}, "the key 'permeability' is missing");
  expect({{"water", "water: {permeability: 1e-5 mm}"}}, "a permeability or flux in m/s");
  expect({{"water", "water: {permeability: -1e-5 m/s}"}}, "permeability");
  expect({{"water", "water: {permeability: 0 m/s}"}}, "permeability");
  expect({{"water", "water: {permeability: {hazen: 1}}"}}, "kozeny_carman");
  expect({{"water", "water: {permeability: {kozeny_carman: {diameter: 0.2 mm}}}"}}, "needs 'void_ratio'");
  expect({{"water", "water: {permeability: [[0.5, 1e-5 m/s], [0.8, 4e-5 m/s]]}"}}, "needs 'void_ratio'");
  expect({{"water", "water: {permeability: [[0.8, 1e-5 m/s], [0.5, 4e-5 m/s]], void_ratio: 0.6}"}},
         "must be larger than");
  expect({{"water", "water: {permeability: 1e-5 m/s, bulk_modulus: -2 GPa}"}}, "bulk_modulus");
  expect({{"water", "water: {permeability: 1e-5 m/s, void_ratio: 0}"}}, "void_ratio");
  expect({{"water", "water: {permeability: 1e-5 m/s, unit_weight: 0 kN/m3}"}}, "unit_weight");
  expect({{"water", "water: {permeability: 1e-5 m/s, undrained: maybe}"}}, "undrained");
  expect({{"water", "water: {permeability: 1e-5 m/s, table: 2 m}"}}, "table");
  expect({{"water", "water: {permeability: 1e-5 m/s, regions: {lou: {}}}"}}, "did you mean 'low'");
}

TEST(WaterInACase, FaultsOfItsBoundary) {
  const auto boundary = [](const std::string& item) {
    return std::pair<std::string, std::string>{"boundary",
                                               "boundary: [{on: bottom, fix: [u1, u2]}, " + item + "]"};
  };
  expect({boundary("{on: top, pore_pressure: 1 m}")}, "pore_pressure");
  expect({boundary("{on: top, flux: 1 kPa}")}, "flux");
  expect({boundary("{on: top_left, flux: 1 mm/s}")}, "a flux");
  expect(
      {{"water", "water: {permeability: 1e-5 m/s, regions: {low: {}}}"}, boundary("{on: top, flux: 1 mm/s}")},
      "no element has water");
  expect({boundary("{on: odd, drained: true}")}, "no node of 'odd' carries");
  expect({boundary("{on: top, drained: true, flux: 1 mm/s}")}, "beside 'drained'");
  expect({boundary("{on: top, pore_pressure: 1 kPa}, {on: left, pore_pressure: 2 kPa}")},
         "two different values at the node");
  expect({boundary("{on: top, move: {u2: -1 mm}}")}, "with water the time is physical");
  expect({{"water", "water: {permeability: 1e-5 m/s}"}, boundary("{on: top, water_level: 3 m}")}, "'level'");
  expect(
      {{"water", ""}, boundary("{on: top, drained: true}"), {"monitors", ""}, {"steps", "steps: {count: 1}"}},
      "the case has no water");
  expect({{"water", ""},
          {"boundary", "boundary: [{on: bottom, fix: [u1, u2]}]"},
          {"steps", "steps: {count: 1}"}},
         "the case has no water");
}

TEST(WaterInACase, GoesThroughExplicitStepsButForWhatTheyDoNotTake) {
  const std::pair<std::string, std::string> steps{
      "steps", "steps: {duration: 1 d, count: 2, method: explicit, explicit_steps: 1000}"};
  EXPECT_EQ(faults_of({steps}), "");
  expect({steps, {"boundary", "boundary: [{on: bottom, fix: [u1, u2]}, {on: top, free_water: 2 m}]"}},
         "explicit steps take no interfaces, beams, anchors or free water yet, here");
  const std::string density =
      "materials: {ground: {model: elastic, E: 10 MPa, nu: 0.3, Gc: 2 MPa, lc: 10 mm, density: 2000 kg/m3}}";
  const std::pair<std::string, std::string> real{
      "steps", "steps: {duration: 1 s, count: 2, method: explicit, time: real}"};
  EXPECT_EQ(faults_of({real, {"materials", density}}), "");
  expect({real,
          {"materials", density},
          {"boundary", "boundary: [{on: bottom, fix: [u1, u2], quiet: true}, {on: top, drained: true}]"}},
         "quiet boundaries know the waves of dry ground alone");
}

TEST(WaterInACase, FaultsOfWhatItDoesNotTake) {
  expect({{"water", "water: {permeability: 1e-5 m/s, level: 2 m, bulk_modulus: 2.2}"}},
         "bulk_modulus: 2.2 Pa; air has 100 kPa, water 2.2 GPa: write the unit");
  expect({{"steps", "steps: {count: 2}"}}, "duration: 10 d");
  expect({{"steps", "steps: {stages: [{name: one, count: 2}]}"}}, "until: 10 d");
  expect({{"steps", "steps: {stages: [{measure: {on: top, displacement: u2}, grow: -1 mm, count: 2}]}"}},
         "water flows in a known time");
  expect({{"steps", "steps: {duration: 1 d, count: 2, method: automatic}"}}, "no water yet");
  expect({{"steps", "steps: {duration: 1 h, count: 60, first: 2 min}"}}, "go beyond the end");
  expect({{"water", ""},
          {"monitors", ""},
          {"boundary", "boundary: [{on: bottom, fix: [u1, u2]}]"},
          {"steps", "steps: {count: 4, first: 0.1}"}},
         "first");
  expect({{"boundary", "boundary: [{on: [bottom, slip], fix: [u1, u2]}, {on: top, drained: true}]"},
          {"", "interfaces: {slip: {on: left, friction: 20 deg, water: leaky}}"}},
         "resistance");
  expect({{"water", "water: {permeability: 1e-5 m/s}"},
          {"boundary", "boundary: [{on: bottom, fix: [u1, u2]}, {on: top, free_water: 3 m}]"}},
         "free_water: without 'level' below 'water'");
  expect({{"boundary", "boundary: [{on: bottom, fix: [u1, u2]}, {on: top, drained: true, free_water: 3 m}]"}},
         "free_water: beside 'drained'");
  expect(
      {{"mesh",
        "mesh: {element: Q4, rectangle: {size: [2 m, 2 m], elements: [2, 4], regions: {low: [0, 0, 2 m, 1 m]}}}"}},
      "Q8R, T6");
  expect({{"monitors", "monitors: {p: {on: odd, water: pressure}}"}}, "no corner of an element with water");
  expect({{"monitors", "monitors: {p: {on: top, water: level}}"}}, "pressure, outflow, flow");
}

}  // namespace
}  // namespace polargrain::coupler
