// SPDX-License-Identifier: GPL-2.0-or-later
// Pore water through the language of cases, against closed forms and series.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "coupler/points/law_point.hpp"
#include "element/driver.hpp"
#include "element/named_tests.hpp"
#include "tests/support/case_of_laws.hpp"

using namespace polargrain;
using polargrain::testing::case_of;
using polargrain::testing::RunOfLaws;

namespace {

// Terzaghi, both sides drained, by the series sum 2/M sin(M z/h) exp(-M^2 Tv); cv = k Eoed / gw = 1.2e-5 m2/s.
struct Consolidated {
  double time_factor;
  double middle;  ///< p / q
  double quarter;
  double settled;  ///< share of the final settlement
};
constexpr std::array<Consolidated, 6> kTerzaghi{{{0.01, 1.000000, 0.999593, 0.112838},
                                                 {0.05, 0.996869, 0.886152, 0.252313},
                                                 {0.1, 0.949305, 0.735651, 0.356823},
                                                 {0.2, 0.772312, 0.553176, 0.504088},
                                                 {0.5, 0.370777, 0.262188, 0.763950},
                                                 {1.0, 0.107977, 0.076351, 0.931260}}};
constexpr double kTimeOfOne = 1.0 / 1.2e-5;  // s, Tv = 1 of half the height of 2 m

std::string terzaghi(const std::string& mesh, const std::string& sides, const std::string& stages) {
  return "title: A layer between two drains\n"
         "continuum: cauchy\n"
         "mesh: {" +
         mesh +
         "}\n"
         "materials: {clay: {model: elastic, E: 10 MPa, nu: 0.25}}\n"
         "regions: {all: clay}\n"
         "water: {unit_weight: 10 kN/m3, bulk_modulus: 9e4 GPa, permeability: 1e-8 m/s}\n"
         "boundary:\n" +
         sides +
         "  - {on: top, pressure: 100 kPa, drained: true}\n"
         "  - {on: bottom, pore_pressure: 0 kPa}\n"
         "steps: {tolerance: 1e-8, stages: [" +
         stages +
         "]}\n"
         "monitors:\n"
         "  out: {on: [top, bottom], water: outflow}\n"
         "  flow: {on: [top, bottom], water: flow}\n"
         "  mean: {on: all, water: pressure}\n";
}

std::string stages_of_terzaghi(int steps) {
  std::string stages;
  for (const Consolidated& at : kTerzaghi)
    stages += fmt::format("{}{{until: {:.6f} s, count: {}}}", stages.empty() ? "" : ", ",
                          at.time_factor * kTimeOfOne, steps);
  return stages;
}

TEST(WaterCase, TerzaghiAtSixTimes) {
  const RunOfLaws run(terzaghi("rectangle: {size: [0.25 m, 2 m], elements: [1, 32], levels: {middle: 1 m, "
                               "quarter: 1.5 m}}",
                               "  - {on: [left, right], fix: [u1]}\n  - {on: bottom, fix: [u2]}\n",
                               stages_of_terzaghi(80)) +
                      "  middle: {on: middle, water: pressure}\n"
                      "  quarter: {on: quarter, water: pressure}\n"
                      "  top: {on: top, displacement: u2}\n");
  EXPECT_NEAR(run.value("middle", 0), 1e5, 10.0) << "at once, all of the load";
  const double settlement = 1e5 * 2.0 / 12e6;
  for (std::size_t k = 0; k < kTerzaghi.size(); ++k) {
    const Consolidated& exact = kTerzaghi[k];
    const std::size_t step = 80 * (k + 1);
    // Half a percent of the load; before Tv = 0.05 the sudden load is sharp in time.
    const double tolerance = k == 0 ? 1e-2 : 5e-3;
    EXPECT_NEAR(run.value("middle", step) / 1e5, exact.middle, tolerance) << exact.time_factor;
    EXPECT_NEAR(run.value("quarter", step) / 1e5, exact.quarter, tolerance) << exact.time_factor;
    EXPECT_NEAR(-run.value("top", step) / settlement, exact.settled, 5e-3) << exact.time_factor;
    // No water is stored: all that leaves makes room.
    EXPECT_NEAR(run.value("out", step), -0.25 * run.value("top", step), 1e-6 * 0.25 * settlement);
  }
  const std::size_t last = run.steps();
  const double step = 0.5 * kTimeOfOne / 80;
  EXPECT_NEAR(run.last("flow"), (run.last("out") - run.value("out", last - 1)) / step,
              1e-6 * run.last("flow"));
}

// Four steps that are taken in parts, of 3 % of the load each, are as good as many; four whole ones are not.
TEST(WaterCase, StepsFollowTheRateOfPressure) {
  const auto error = [](const std::string& limit) {
    std::string text = terzaghi("rectangle: {size: [0.25 m, 2 m], elements: [1, 16]}",
                                "  - {on: [left, right], fix: [u1]}\n  - {on: bottom, fix: [u2]}\n",
                                fmt::format("{{until: {:.6f} s, count: 4}}", 0.5 * kTimeOfOne)) +
                       "  top: {on: top, displacement: u2}\n";
    text.replace(text.find("permeability"), 0, limit);
    const RunOfLaws run(text);
    return std::abs(-run.last("top") / (1e5 * 2.0 / 12e6) - kTerzaghi[4].settled);
  };
  EXPECT_LT(error("pressure_change: 3 kPa, shortest_step: 50 s, "), 1e-2);
  EXPECT_GT(error(""), 3e-2);
}

// The same in space, with steps that grow.
TEST(WaterCase, TerzaghiInSpaceWithGrowingSteps) {
  for (const char* const element : {"H20R", "T10"}) {
    const RunOfLaws run(
        terzaghi(
            fmt::format("element: {}, box: {{size: [0.25 m, 0.25 m, 2 m], elements: [1, 1, 16]}}", element),
            "  - {on: [left, right], fix: [u1]}\n  - {on: [front, back], fix: [u2]}\n"
            "  - {on: bottom, fix: [u3]}\n",
            fmt::format("{{until: {:.6f} s, count: 60, first: 50 s}}", 0.5 * kTimeOfOne)) +
        "  top: {on: top, displacement: u3}\n");
    // Steps of 1 to 2 % of the elapsed time, at the end some 5 %: the error of th = 1 is half of that.
    EXPECT_NEAR(-run.last("top") / (1e5 * 2.0 / 12e6), kTerzaghi[4].settled, 1e-2) << element;
  }
}

// De Leeuw's cylinder, loaded at its drained surface: the pressure of the axis rises before it falls.
TEST(WaterCase, ACylinderShowsTheRiseOfPressure) {
  std::string stages;
  const std::array<std::array<double, 2>, 4> exact{
      {{0.01, 1.086305}, {0.05, 1.182255}, {0.1, 1.107317}, {0.2, 0.776137}}};
  for (const auto& [time_factor, pressure] : exact)
    stages += fmt::format("{}{{until: {:.3f} s, count: 24}}", stages.empty() ? "" : ", ",
                          time_factor / 1.1111111e-5);
  const RunOfLaws run(
      "title: A cylinder between two plates\n"
      "continuum: cauchy\n"
      "mesh: {cylinder: {radius: 1 m, height: 0.2 m, elements: [12, 10, 1], sector: quarter}}\n"
      "materials: {clay: {model: elastic, E: 10 MPa, nu: 0.2}}\n"
      "regions: {all: clay}\n"
      "water: {unit_weight: 10 kN/m3, bulk_modulus: 9e4 GPa, permeability: 1e-8 m/s}\n"
      "boundary:\n"
      "  - {on: left, fix: [u1]}\n"
      "  - {on: front, fix: [u2]}\n"
      "  - {on: [bottom, top], fix: [u3]}\n"
      "  - {on: side, pressure: 100 kPa, drained: yes}\n"
      "steps: {tolerance: 1e-8, stages: [" +
      stages +
      "]}\n"
      "monitors: {axis: {on: axis, water: pressure}}\n");
  EXPECT_NEAR(run.value("axis", 0) / 1e5, 1.0, 3e-2);  // the sudden load overshoots in a step of no duration
  for (std::size_t k = 0; k < exact.size(); ++k)
    EXPECT_NEAR(run.value("axis", 24 * (k + 1)) / 1e5, exact[k][1], 5e-3) << exact[k][0];
}

// Half of the ground beside a sheet pile in a layer: between bottom and toe the head is the mean of both sides.
/// @param elements over the depth of the layer
double flow_under_pile(double depth, int elements) {
  const RunOfLaws run(fmt::format(
      "title: Flow under a sheet pile\n"
      "continuum: cauchy\n"
      "mesh: {{rectangle: {{size: [3 m, 1 m], elements: [{}, {}], lines: {{below: [0, 0, 0, {} m]}}}}}}\n"
      "materials: {{sand: {{model: elastic, E: 100 MPa, nu: 0.25}}}}\n"
      "regions: {{all: sand}}\n"
      "water: {{unit_weight: 10 kN/m3, permeability: 1e-4 m/s}}\n"
      "boundary:\n"
      "  - {{on: [left, right], fix: [u1]}}\n"
      "  - {{on: bottom, fix: [u1, u2]}}\n"
      "  - {{on: top, pore_pressure: 10 kPa}}\n"
      "  - {{on: below, drained: true}}\n"
      "steps: {{duration: 1 a, count: 1, tolerance: 1e-8}}\n"
      "monitors: {{in: {{on: top, water: flow}}, out: {{on: below, water: flow}}}}\n",
      3 * elements, elements, 1.0 - depth));
  EXPECT_NEAR(run.last("in"), -run.last("out"), 1e-6 * run.last("out"));
  return run.last("out") / (1e-4 * 2.0);  // 10 kPa are 1 m of water, half of the difference
}

TEST(WaterCase, FlowUnderASheetPile) {
  // K'/2K of sin(pi s / 2T). The toe is a singularity: the error falls like the element, 1.3 % with T/16 at s = T/2.
  for (const auto& [depth, exact] : {std::pair{0.25, 0.734609}, {0.5, 0.5}, {0.75, 0.340317}}) {
    const double coarse = flow_under_pile(depth, 16);
    const double fine = flow_under_pile(depth, 32);
    EXPECT_NEAR(fine, exact, 0.01) << depth;
    EXPECT_NEAR(2.0 * fine - coarse, exact, 1e-3) << depth;
  }
}

std::string block(const std::string& water, const std::string& drain, const std::string& steps) {
  return "title: A block\n"
         "continuum: cauchy\n"
         "mesh: {rectangle: {size: [2 m, 1 m], elements: [4, 2]}}\n"
         "materials: {sand: {model: elastoplastic, E: 20 MPa, nu: 0.3, friction_angle: 30 deg, dilatancy_angle: 5 "
         "deg, cohesion: 10 kPa}}\n"
         "regions: {all: sand}\n" +
         water +
         "boundary:\n"
         "  - {on: bottom, fix: [u1, u2]}\n"
         "  - {on: left, fix: [u1]}\n"
         "  - {on: top, pressure: [[0, 0 kPa], [10, 30 kPa], [20, 10 kPa]]}\n" +
         drain + "steps: " + steps +
         "\n"
         "monitors: {top: {on: top, displacement: u2}, side: {on: right, displacement: u1}, "
         "base: {on: bottom, reaction: u2}}\n";
}

// Water that leaves at once leaves the answers of the dry ground, of a law that yields.
TEST(WaterCase, DrainedAtOnceIsDry) {
  const std::string stages = "{tolerance: 1e-10, stages: [{until: 10, count: 8}, {until: 20, count: 8}]}";
  const RunOfLaws dry(block("", "", stages));
  const RunOfLaws held(block("water: {permeability: 1e-4 m/s}\n", "  - {on: all, drained: true}\n", stages));
  const RunOfLaws open(block("water: {permeability: 1e3 m/s}\n", "  - {on: top, drained: true}\n", stages));
  for (std::size_t step = 0; step <= dry.steps(); ++step)
    for (const char* const name : {"top", "side", "base"}) {
      const double exact = dry.value(name, step);
      const double scale = std::abs(dry.value(name, 8));
      EXPECT_NEAR(held.value(name, step), exact, 1e-9 * scale) << name << step;
      EXPECT_NEAR(open.value(name, step), exact, 1e-5 * scale) << name << step;
    }
}

// Water at rest in ground of K0 is in balance from the start: nothing moves, nothing flows.
TEST(WaterCase, GroundUnderWaterIsAtRest) {
  const std::string ground =
      "title: Ground below 1 m of water\n"
      "continuum: cauchy\n"
      "mesh: {rectangle: {size: [4 m, 4 m], elements: [4, 4], regions: {crust: [0, 3 m, 4 m, 4 m]}}}\n"
      "materials: {sand: {model: elastic, E: 20 MPa, nu: 0.3}}\n"
      "regions: {rest: sand, crust: sand}\n"
      "boundary:\n"
      "  - {on: [left, right], fix: [u1]}\n"
      "  - {on: bottom, fix: [u2]}\n"
      "  - {on: top, pressure: LOAD, drained: true}\n"
      "body: [{unit_weight: 20 kN/m3}]\n"
      "initial_stress: [{surface: 4 m, unit_weight: 20 kN/m3, K0: 0.5, surcharge: LOAD}]\n"
      "water: {unit_weight: 10 kN/m3, permeability: 1e-5 m/s, level: 5 m}\n"
      "steps: {duration: 1 d, count: 2, tolerance: 1e-8}\n"
      "monitors: {bottom: {on: bottom, water: pressure}, flow: {on: top, water: flow}, "
      "moved: {on: top, displacement: u2}, side: {on: left, reaction: u1}}\n";
  std::string text = ground;
  for (std::size_t at = 0; (at = text.find("LOAD")) != std::string::npos;) text.replace(at, 4, "10 kPa");
  const RunOfLaws run(text);
  EXPECT_NEAR(run.last("bottom"), 50e3, 1e-6);
  EXPECT_LT(std::abs(run.last("flow")), 1e-14);
  EXPECT_LT(std::abs(run.last("moved")), 1e-10);
  // Half of the effective weight of 10 kN/m3, and the water.
  EXPECT_NEAR(run.last("side"), 0.5 * 10e3 * 8.0 + 10e3 * 4.0 * 3.0, 1e-3);
}

// Undrained biaxial compression of an elastic block: closed form with n/Kw = 1e-9 and 1e-7 1/Pa.
TEST(WaterCase, UndrainedIsTheLimitWithoutFlow) {
  struct Limit {
    const char* bulk_modulus;
    double pressure, shortening;
  };
  for (const Limit& exact :
       {Limit{"500 MPa", 49603.174603, 6.27480159e-3}, Limit{"5 MPa", 27777.7778, 7.63888889e-3}})
    for (const auto& [way, drain] :
         {std::pair{"undrained: true", ", drained: true"}, {"permeability: 1e-12 m/s", ""}}) {
      const RunOfLaws run(
          fmt::format("title: An undrained block\n"
                      "continuum: cauchy\n"
                      "mesh: {{rectangle: {{size: [1 m, 1 m], elements: [3, 3]}}}}\n"
                      "materials: {{clay: {{model: elastic, E: 10 MPa, nu: 0.25}}}}\n"
                      "regions: {{all: clay}}\n"
                      "water: {{void_ratio: 1, bulk_modulus: {}, {}}}\n"
                      "boundary:\n"
                      "  - {{on: left, fix: [u1]}}\n"
                      "  - {{on: bottom, fix: [u2]}}\n"
                      "  - {{on: top, pressure: [[0, 0], [1 s, 100 kPa]]{}}}\n"
                      "steps: {{duration: 1 s, count: 1, tolerance: 1e-10}}\n"
                      "monitors: {{p: {{on: all, water: pressure}}, top: {{on: top, displacement: u2}}}}\n",
                      exact.bulk_modulus, way, drain));
      EXPECT_NEAR(run.last("p"), exact.pressure, 1e-3) << way;
      EXPECT_NEAR(run.last("top"), -exact.shortening, 1e-10) << way;
    }
}

// A closed mesh of a law that yields and contracts, against the undrained test of one point of it.
TEST(WaterCase, AClosedMeshIsAnUndrainedTest) {
  for (const char* const dilatancy : {"-3 deg", "0 deg", "4 deg"}) {
    const RunOfLaws run(fmt::format(
        "title: A closed specimen\n"
        "continuum: cauchy\n"
        "mesh: {{rectangle: {{size: [1 m, 2 m], elements: [2, 2]}}}}\n"
        "materials: {{sand: {{model: elastoplastic, E: 50 MPa, nu: 0.3, friction_angle: 30 deg, dilatancy_angle: {}, "
        "cohesion: 5 kPa}}}}\n"
        "regions: {{all: sand}}\n"
        "water: {{bulk_modulus: 9e4 GPa, void_ratio: 0.01, undrained: true}}\n"
        "initial_stress: [{{stress: [-100 kPa, -100 kPa, -100 kPa, 0]}}]\n"
        "boundary:\n"
        "  - {{on: left, fix: [u1]}}\n"
        "  - {{on: bottom, fix: [u2]}}\n"
        "  - {{on: right, pressure: 100 kPa}}\n"
        "  - {{on: top, move: {{u2: [[0, 0], [20, -20 mm]]}}}}\n"
        "steps: {{duration: 20 s, count: 20, tolerance: 1e-11}}\n"
        "monitors: {{p: {{on: all, water: pressure}}, force: {{on: top, reaction: u2}}}}\n",
        dilatancy));
    coupler::LawPoint point(run.the_case().materials.at("sand")->make(nullptr), 100e3);
    element::NamedTest test;
    test.name = "biaxial";
    test.drive.amount = 0.01;
    test.undrained = true;
    test.rows = 20;
    const element::Stage stage = element::completed(element::stage_of(test, point.room()), point.room());
    element::Accuracy accuracy;
    accuracy.pressure = 100e3;
    accuracy.tolerance = 1e-11;
    const element::Outcome outcome = element::follow(point, std::vector{stage}, accuracy);
    ASSERT_EQ(outcome.failure, "");
    ASSERT_EQ(outcome.rows.size(), 21U);
    for (std::size_t row = 1; row <= 20; ++row) {
      EXPECT_NEAR(run.value("p", row), outcome.rows[row].pore_pressure, 0.1) << dilatancy << row;  // 1e-6
      const double effective = run.value("force", row) + run.value("p", row);
      EXPECT_NEAR(effective, outcome.rows[row].stress(1), 0.1) << dilatancy << row;
    }
  }
}

// Small loads in large deformation: strains of 1e-9 are balanced as those of 1e-4 are, and give as much pressure.
TEST(WaterCase, LargeDeformationKnowsSmallStrains) {
  for (const auto& [mesh, sides] : {std::pair{"rectangle: {size: [1 m, 1 m], elements: [2, 2]}", ""},
                                    {"box: {size: [1 m, 1 m, 1 m], elements: [2, 2, 2]}, element: H20R",
                                     "  - {on: front, fix: [u2]}\n  - {on: back, fix: [u2]}\n"}})
    for (const double load : {1e-2, 1e3}) {
      const RunOfLaws run(
          fmt::format("title: An undrained block\n"
                      "continuum: cauchy\n"
                      "deformation: large\n"
                      "mesh: {{{}}}\n"
                      "materials: {{clay: {{model: elastic, E: 10 MPa, nu: 0.25}}}}\n"
                      "regions: {{all: clay}}\n"
                      "water: {{bulk_modulus: 9e4 GPa, undrained: true}}\n"
                      "boundary:\n"
                      "  - {{on: left, fix: [u1]}}\n"
                      "  - {{on: bottom, fix: [{}]}}\n"
                      "{}"
                      "  - {{on: top, pressure: [[0, 0], [1 s, {} Pa]]}}\n"
                      "steps: {{duration: 1 s, count: 1, tolerance: 1e-8}}\n"
                      "monitors: {{p: {{on: all, water: pressure}}}}\n",
                      mesh, *sides == 0 ? "u2" : "u3", sides, load));
      // Plane strain without volume strain: half of the load. Strains of 1e-4 change areas by as much.
      EXPECT_NEAR(run.last("p") / load, 0.5, load > 1.0 ? 2e-4 : 1e-6) << mesh << load;
    }
}

// A flooded pit of 2 m in saturated ground. Quick: the ground below loses no volume, and its water the weight that was dug, but for
// the buoyancy. Then it swells as Terzaghi's layer with one drain.
const std::string kPit =
    "title: A flooded pit\n"
    "continuum: cauchy\n"
    "mesh: {rectangle: {size: [1 m, 4 m], elements: [2, 32], regions: {upper: [0, 2 m, 1 m, 4 m]}, "
    "lines: {floor: [0, 2 m, 1 m, 2 m]}}}\n"
    "materials: {clay: {model: elastic, E: 10 MPa, nu: 0.25}}\n"
    "regions: {upper: clay, rest: clay}\n"
    "water: {unit_weight: 10 kN/m3, bulk_modulus: 9e4 GPa, permeability: 1e-8 m/s, level: 4 m}\n"
    "boundary:\n"
    "  - {on: [left, right], fix: [u1]}\n"
    "  - {on: bottom, fix: [u2]}\n"
    "  - {on: top, drained: true}\n"
    "body: [{unit_weight: 20 kN/m3}]\n"
    "initial_stress: [{surface: 4 m, unit_weight: 20 kN/m3, K0: 0.5}]\n"
    "steps:\n"
    "  tolerance: 1e-8\n"
    "  stages:\n"
    "    - {name: rest, until: 10 s, count: 1}\n"
    "    - {name: dig, remove: upper, until: 20 s, count: 2, boundary: [{on: floor, pressure: 20 kPa}]}\n"
    "    - {name: drain, boundary: [{on: floor, drained: true}], until: 66686.667 s, count: 80}\n"
    "    - {name: wait, until: 1 a, count: 20}\n"
    "monitors:\n"
    "  floor: {on: floor, displacement: u2}\n"
    "  p: {on: bottom, water: pressure}\n"
    "  base: {on: bottom, reaction: u2}\n";

TEST(WaterCase, AFloodedPitSwells) {
  const RunOfLaws run(kPit);
  const double heave = 20e3 * 2.0 / 12e6;
  EXPECT_NEAR(run.value("p", 1), 40e3, 1e-3);
  EXPECT_NEAR(run.value("p", 2), 30e3, 1.0) << "half of it has been dug";
  EXPECT_NEAR(run.value("p", 3), 20e3, 1.0);
  EXPECT_LT(std::abs(run.value("floor", 3)), 1e-4 * heave);
  EXPECT_NEAR(run.value("base", 3), 20e3 * 2.0 + 20e3, 1.0);
  EXPECT_NEAR(run.value("floor", 83) / heave, 0.504088, 1e-2);  // Tv = 0.2
  EXPECT_NEAR(run.last("floor") / heave, 1.0, 1e-6);
  EXPECT_NEAR(run.last("p"), 40e3, 0.1);
}

// In any stage the run goes on to the same bits.
TEST(WaterCase, GoesOnToTheSameBits) {
  std::string text = kPit;
  text.replace(text.find("permeability"), 0, "pressure_change: 1 kPa, shortest_step: 1 s, ");
  const RunOfLaws whole(text);
  for (const int step : {0, 1, 2, 3, 40, 90}) {
    const RunOfLaws parts(text, step);
    for (std::size_t k = 0; k <= whole.steps(); ++k)
      for (const char* const name : {"floor", "p", "base"})
        ASSERT_EQ(parts.value(name, k), whole.value(name, k))
            << name << " of step " << k << ", behind " << step;
  }
}

}  // namespace
