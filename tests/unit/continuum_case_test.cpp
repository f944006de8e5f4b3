// SPDX-License-Identifier: GPL-2.0-or-later
// The kind of continuum and spread slips as a case file has them.
#include <gtest/gtest.h>

#include "fem/material/elastoplastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/material/slip_driven.hpp"
#include "fem/solver/solver.hpp"
#include "fem/spread/spread_slip.hpp"
#include "tests/support/edited_case.hpp"

namespace polargrain::coupler {
namespace {

// Lines are counted in the expectations below.
const std::string kCaseOfContinuumCase = R"(title: A specimen
continuum: {kind: cauchy, spread: 50 mm}
mesh: {rectangle: {size: [0.2 m, 0.4 m], elements: [4, 8], regions: {plate: [0, 0.35 m, 0.2 m, 0.4 m]}}}
materials:
  sand: {model: elastoplastic, E: 20 MPa, nu: 0.3, confining: 100 kPa, friction_angle: [40 deg, 30 deg], dilatancy_angle: 8 deg, cohesion: 0, hardening_shear: 0.3}
  steel: {model: elastic, E: 2 GPa, nu: 0.2, confining: 100 kPa}
regions: {plate: steel, rest: sand}
boundary:
  - {on: bottom, fix: [u1, u2]}
  - {on: [left, right], pressure: 100 kPa}
  - {on: top, move: {u2: -30 mm}}
steps: {count: 20}
)";

class ContinuumCase : public polargrain::testing::EditedCase {
 protected:
  ContinuumCase() : EditedCase("continuum_case", kCaseOfContinuumCase) {}
};

using Local = fem::LocalMaterial<fem::ElastoplasticLaw<2>>;

TEST_F(ContinuumCase, spreads_the_slips_of_elastoplastic_materials_beside_elastic_ones) {
  const Case found = read();
  EXPECT_EQ(found.spread, 0.05);
  EXPECT_EQ(found.problem.continuum, fem::Continuum::cauchy);
  EXPECT_NE(std::dynamic_pointer_cast<fem::SlipDriven<2>>(found.materials.at("sand")->make(nullptr)),
            nullptr);
  EXPECT_EQ(std::dynamic_pointer_cast<fem::SlipDriven<2>>(found.materials.at("steel")->make(nullptr)),
            nullptr);
}

TEST_F(ContinuumCase, a_specimen_between_plates_slips_past_its_peak) {
  Case found = read();
  for (auto& [region, material] : found.problem.materials)
    material = found.materials.at(found.regions.at(region))->make(nullptr);
  fem::add_spread_slip(found.problem, {found.spread});
  fem::Solver<2> solver(std::move(found.problem), found.solver);
  ASSERT_TRUE(solver.equilibrate().converged);
  double peak = 0.0;
  for (const StepTarget& step : found.plan) {
    const fem::StepReport report = solver.advance(step.amount);
    ASSERT_TRUE(report.converged) << report.message;
    peak = std::max(peak, -solver.reaction("top")(1));
  }
  EXPECT_LT(-solver.reaction("top")(1), 0.97 * peak);
  EXPECT_GT(peak, 3.0 * 100e3 * 0.2);  // (1 + sin 40) / (1 - sin 40) = 4.6, rough plates add to it
}

TEST_F(ContinuumCase, slips_may_be_held_at_boundaries) {
  EXPECT_EQ(read("spread: 50 mm", "spread: 50 mm, hold: [bottom, top]").slips_held_on,
            (std::vector<std::string>{"bottom", "top"}));
}

TEST_F(ContinuumCase, without_a_spread_it_is_the_case_of_before) {
  for (const char* none : {"cauchy", "{kind: cauchy}", "{kind: cauchy, spread: 0}"}) {
    const Case found = read("{kind: cauchy, spread: 50 mm}", none);
    EXPECT_EQ(found.spread, 0.0);
    EXPECT_EQ(found.problem.continuum, fem::Continuum::cauchy);
    EXPECT_NE(std::dynamic_pointer_cast<Local>(found.materials.at("sand")->make(nullptr)), nullptr) << none;
  }
  EXPECT_EQ(fault("{kind: cauchy, spread: 50 mm}", "cosmic"),
            "2: case: continuum: expected one of cosserat, cauchy, found 'cosmic'");
}

TEST_F(ContinuumCase, faults_say_where_slips_are_not_spread) {
  EXPECT_NE(
      fault("spread: 50 mm", "spread: 5 d50").find("2: continuum: spread: 5 d50: no material has grains"),
      std::string::npos);
  EXPECT_NE(fault("spread: 50 mm", "spread: d50")
                .find("2: continuum: spread: d50: expected a length, 'measured', or"),
            std::string::npos);
  EXPECT_NE(fault("spread: 50 mm", "spread: 5.4 d5").find("median diameters of the grains, such as '5 d50'"),
            std::string::npos);
  EXPECT_NE(fault("spread: 50 mm", "hold: top").find("2: continuum: hold: without 'spread'"),
            std::string::npos);
  EXPECT_NE(fault("spread: 50 mm", "spread: 50 mm, hold: [top, botom]")
                .find("hold: the mesh has no boundary or node set 'botom'; did you mean 'bottom'?"),
            std::string::npos);
  const std::string law =
      "model: elastoplastic, E: 20 MPa, nu: 0.3, confining: 100 kPa, friction_angle: [40 deg, 30 deg], dilatancy_angle: "
      "8 deg, cohesion: 0, hardening_shear: 0.3";
  EXPECT_NE(fault(law, "model: elastic, E: 20 MPa, nu: 0.3").find("2: continuum: spread: no material"),
            std::string::npos);
  EXPECT_NE(fault("hardening_shear: 0.3", "hardening_shear: 0.3, invariants: [0.375, 0.125, 0.25]")
                .find("5: material 'sand': slips are spread with the invariants"),
            std::string::npos);
}

}  // namespace
}  // namespace polargrain::coupler
