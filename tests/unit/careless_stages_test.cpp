// SPDX-License-Identifier: GPL-2.0-or-later
// Remarks on cases whose parts come and go: time zero is judged by the parts that are there.
#include "app/remarks/start_of_step_zero.hpp"
#include "app/remarks/stress_scale.hpp"
#include "coupler/case/document_kind.hpp"
#include "tests/support/careless_scenes.hpp"

namespace polargrain::testing {
namespace {

/// Ground of 10 m, elastic, its weight at once; a bank of 2 m comes on half of it, a pit is dug in the other half.
const std::string kStages = R"(title: A bank comes, a pit goes
continuum: cauchy
mesh:
  rectangle:
    size: [20 m, 12 m]
    elements: [10, 6]
    regions: {bank: [10 m, 10 m, 20 m, 12 m], pit: [0, 8 m, 4 m, 10 m], void: [0, 10 m, 10 m, 12 m]}
materials:
  soil: {model: elastic, E: 1 MPa, nu: 0}
  fill: {model: elastic, E: 2 MPa, nu: 0}
regions: {bank: fill, pit: soil, rest: soil}
boundary:
  - {on: bottom, fix: [u1, u2]}
  - {on: [left, right], fix: [u1]}
body: [{unit_weight: 18 kN/m3}]
steps:
  stages:
    - {name: bank, place: bank, count: 2}
    - {name: pit, remove: pit, count: 2}
monitors: {base: {on: bottom, reaction: u2}}
output: {table: [base]}
)";

const std::string kStart =
    "    - {name: start, count: 1}\n"
    "    - {name: bank, place: bank, count: 2}";

/// Calls look(scene) with the scene of a case.
auto look_at_case(const std::string& text, const auto& look) {
  const Scratch scratch("careless_stages");
  const std::string source = POLARGRAIN_SOURCE_DIRECTORY;
  write(scratch.path() / "case.yaml", text);
  write(scratch.path() / "cell.in", content(source + "/liggghts_inputs/cells/hooke_radii.in"));
  std::filesystem::copy_file(source + "/cases/footing_cells/packing100.h5", scratch.path() / "grains.h5");
  const coupler::Case the_case = coupler::read_case(scratch.path() / "case.yaml");
  const coupler::Entry document =
      coupler::load_document_of(coupler::DocumentKind::problem, the_case.file, {});
  return look(app::Scene(the_case, document, {}));
}

std::optional<app::StartOfStepZero> start_of(const std::string& text) {
  return look_at_case(text, [](const app::Scene& scene) { return app::start_of_step_zero(scene); });
}

std::string staged(const std::string& good, const std::string& bad) {
  return replaced(replaced(kStages, "    - {name: bank, place: bank, count: 2}", kStart), good, bad);
}

/// Ground between smooth sides settles by weight H^2 / 2 E = 900 mm, whatever a later stage places on it.
constexpr double kSettlement = 18e3 * 10.0 * 10.0 / 2.0 / 1e6;

TEST(StagesAtTimeZero, ABankThatComesLaterHasNoWeightYet) {
  const auto start = start_of(staged("", ""));
  ASSERT_TRUE(start.has_value());
  EXPECT_NEAR(start->largest_displacement, kSettlement, 1e-9);
}

/// Nobody has asked the engine about these grains, so their moduli are not known; at time zero none of them is there.
TEST(StagesAtTimeZero, GrainsThatComeLaterNeedNoModuli) {
  const auto start = start_of(staged("fill: {model: elastic, E: 2 MPa, nu: 0}",
                                     "fill: {model: cell, script: cell.in, packing: grains.h5}"));
  ASSERT_TRUE(start.has_value());
  EXPECT_NEAR(start->largest_displacement, kSettlement, 1e-9);
}

/// The bank comes with a stress of its own, which counts neither as a stress at time zero nor as a change of it.
TEST(StagesAtTimeZero, StressOfABankThatComesLaterIsNotCounted) {
  const std::string ground = "body: [{unit_weight: 18 kN/m3}]\ninitial_stress:\n";
  const std::string bank = "  - {surface: 12 m, unit_weight: 18 kN/m3, K0: 0.5, region: bank}\n";
  const auto without = start_of(staged("body: [{unit_weight: 18 kN/m3}]\n", ground + bank));
  ASSERT_TRUE(without.has_value());
  EXPECT_FALSE(without->has_stress);
  const auto balanced =
      start_of(staged("body: [{unit_weight: 18 kN/m3}]\n",
                      ground + bank + "  - {surface: 10 m, unit_weight: 18 kN/m3, K0: 0.5, region: rest}\n" +
                          "  - {surface: 10 m, unit_weight: 18 kN/m3, K0: 0.5, region: pit}\n"));
  ASSERT_TRUE(balanced.has_value());
  EXPECT_NEAR(balanced->stress_change, 0.0, 1e-9);
}

TEST(StagesAtTimeZero, CheckTellsTheSettlement) {
  const app::Remarks remarks = remarks_of({"Settles", staged("E: 1 MPa", "E: 5 MPa"),
                                           "fill: {model: elastic, E: 2", "fill: {model: elastic, E: 20"});
  EXPECT_TRUE(std::ranges::any_of(remarks, [](const app::Remark& remark) {
    return remark.at.message.find("moves the body by 180 mm") != std::string::npos;
  })) << app::text_of(remarks, true);
}

/// What holds for a material whenever it comes is told of later ones too.
TEST(StagesAtTimeZero, MaterialsOfLaterPartsAreLookedAt) {
  const app::Remarks remarks =
      remarks_of({"SoftFill", staged("E: 1 MPa", "E: 40 MPa"), "fill: {model: elastic, E: 2 MPa",
                  "fill: {model: elastic, E: 2 kPa"});
  EXPECT_TRUE(std::ranges::any_of(remarks, [](const app::Remark& remark) {
    return remark.rank == app::Rank::wrong &&
           remark.at.message.find("material 'fill': E is 2 kPa") != std::string::npos;
  })) << app::text_of(remarks, true);
}

/// The weight of a part presses by its own height, 2 m; that of all by 12 m.
TEST(StagesAtTimeZero, WeightPressesByTheHeightOfItsRegion) {
  const std::string of_all = "body: [{unit_weight: 18 kN/m3}]";
  EXPECT_NEAR(look_at_case(kStages, app::stress_scale), 18e3 * 12.0, 1e-6);
  const std::string of_pit = replaced(kStages, of_all, "body: [{unit_weight: 18 kN/m3, region: pit}]");
  EXPECT_NEAR(look_at_case(of_pit, app::stress_scale), 18e3 * 2.0, 1e-6);
}

/// `pit` and `rest` are of one material.
TEST(StagesAtTimeZero, AMaterialOfTwoRegionsIsToldOfOnce) {
  const app::Remarks remarks =
      remarks_of({"TwoRegions", staged("E: 1 MPa", "E: 40 MPa"), "nu: 0}\n  fill", "nu: 0.03}\n  fill"});
  EXPECT_EQ(std::ranges::count_if(remarks,
                                  [](const app::Remark& remark) {
                                    return remark.at.message.find("material 'soil': nu is 0.03") !=
                                           std::string::npos;
                                  }),
            1)
      << app::text_of(remarks, true);
}

}  // namespace
}  // namespace polargrain::testing
