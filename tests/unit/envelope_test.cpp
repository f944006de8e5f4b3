// SPDX-License-Identifier: GPL-2.0-or-later
// Failure envelopes and the figures of undrained tests, from curves that are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/element/envelope.hpp"
#include "app/element/undrained_figures.hpp"
#include "element/named_tests.hpp"

namespace polargrain::app {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// At the limit of Mohr and Coulomb: s1 = s3 N + 2 c sqrt(N), N = tan^2(45 deg + phi / 2).
StressCircle at_limit(double least, double angle, double cohesion) {
  const double root = std::tan(0.25 * std::numbers::pi + 0.5 * angle);
  return {root * root * least + 2.0 * cohesion * root, least};
}

TEST(Envelope, OfCirclesAtTheLimitIsAngleAndCohesion) {
  std::vector<StressCircle> circles;
  for (const double least : {25e3, 50e3, 200e3}) circles.push_back(at_limit(least, 35.0 * kDegree, 7e3));
  const auto line = failure_line(circles);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->friction_angle / kDegree, 35.0, 1e-9);
  EXPECT_NEAR(line->cohesion, 7e3, 1e-6);
  EXPECT_NEAR(line->off, 0.0, 1e-6);
}

TEST(Envelope, OfOneCircleOrNoneOfItsKindIsNoLine) {
  const std::array one{at_limit(50e3, 0.5, 0.0)};
  EXPECT_FALSE(failure_line(one));
  const std::array same{one[0], one[0]};
  EXPECT_FALSE(failure_line(same));
  // Centres within 1 % of each other: the line along them would have 30 deg by chance.
  const std::array close{StressCircle{150e3, 50e3}, StressCircle{151.2e3, 50.4e3}};
  EXPECT_FALSE(failure_line(close));
  const std::array apart{StressCircle{150e3, 50e3}, StressCircle{153e3, 51e3}};
  ASSERT_TRUE(failure_line(apart));
  EXPECT_NEAR(failure_line(apart)->friction_angle / kDegree, 30.0, 1e-9);
  const std::array steep{StressCircle{60e3, 50e3}, StressCircle{900e3, 50e3}};  // dr / dcentre = 1
  EXPECT_FALSE(failure_line(steep));
}

// Sand without cohesion: rounding leaves -1e-12 Pa or so, which is nothing.
TEST(Envelope, OfDrySandHasNoNegativeCohesion) {
  ElementResult result;
  result.columns = {"s11_Pa", "s22_Pa", "s33_Pa", "friction_angle_deg"};
  std::vector<ElementResult> results;
  const std::vector<double> pressures{25e3, 50e3, 200e3};
  for (const double least : pressures) {
    const StressCircle circle = at_limit(least, 35.0 * kDegree, -1e-9);
    ElementCurve curve;
    curve.name = "sand";
    curve.rows = {{-circle.least, -circle.largest, -circle.least, 35.0}};
    result.curves = {curve};
    results.push_back(result);
  }
  const Envelopes envelopes = envelopes_of(results, pressures);
  EXPECT_LT(envelopes.at_states.front().second.front().line->cohesion, 0.0);
  const std::string text = envelope_summary(envelopes);
  EXPECT_EQ(text.find("-0.0"), std::string::npos) << text;
  EXPECT_NE(text.find("35.00"), std::string::npos) << text;
  EXPECT_NE(envelope_charts(envelopes).find("sand: 35.00 deg, 0.00 kPa"), std::string::npos);
}

/// @param pores of the stages: -1 is drained
ElementResult with_stages(const std::vector<int>& pores) {
  ElementResult result;
  result.columns = {"stage", "row", "axial_strain", "e12", "p_Pa", "friction_angle_deg", "pore_pressure_Pa"};
  for (const int pore : pores) result.stages.emplace_back().pore = pore;
  return result;
}

ElementCurve undrained(const std::vector<double>& mean_stress) {
  ElementCurve curve;
  for (std::size_t k = 0; k < mean_stress.size(); ++k) {
    const auto row = static_cast<double>(k);
    curve.rows.push_back(
        {1.0, row, 0.01 * row, 0.0, mean_stress[k], 20.0 + row, mean_stress[0] - mean_stress[k]});
  }
  return curve;
}

/// The angles of a test whose axial stress goes with them.
ElementResult with_angles(const std::vector<double>& angles) {
  ElementResult result;
  result.columns = {"s11_Pa", "s22_Pa", "s33_Pa", "friction_angle_deg"};
  ElementCurve curve;
  curve.name = "sand";
  for (const double angle : angles) {
    const StressCircle circle = at_limit(100e3, angle * kDegree, 0.0);
    curve.rows.push_back({-circle.least, -circle.largest, -circle.least, angle});
  }
  result.curves = {curve};
  return result;
}

TEST(Envelope, OfATestThatEndsBeforeItsPeakHasNoPeak) {
  const std::vector<double> pressures{100e3, 200e3};
  const std::vector<ElementResult> results{with_angles({0.0, 20.0, 35.0, 33.0}),
                                           with_angles({0.0, 20.0, 30.0, 34.0})};
  const Envelopes rising = envelopes_of(results, pressures);
  const std::string text = envelope_summary(rising);
  EXPECT_NE(text.find("sand: at 200 kPa the largest angle is the last row: no peak was reached\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("at 100 kPa"), std::string::npos) << text;
  EXPECT_EQ(text.find("peak, "), std::string::npos) << text;
  const std::string table = envelope_table(rising);
  EXPECT_NE(table.find("sand,peak,100000,"), std::string::npos) << table;
  EXPECT_NE(table.find("sand,largest,200000,"), std::string::npos) << table;
  EXPECT_NE(envelope_charts(rising).find("no peak was reached"), std::string::npos);
  // Of a plateau the tolerance of stresses may leave the last row a little above the others.
  const std::vector<ElementResult> flat{with_angles({0.0, 35.0, 34.0}), with_angles({0.0, 35.0, 35.01})};
  EXPECT_EQ(envelope_summary(envelopes_of(flat, pressures)).find("no peak"), std::string::npos);
}

TEST(Envelope, IsOfTestsThatMayFail) {
  ElementSpecification specification;
  specification.stages.resize(2);
  specification.stages[0].name = "consolidation";
  for (const char* const name : {"isotropic", "oedometer", "radial_unloading"}) {
    specification.stages[1].name = name;
    EXPECT_FALSE(can_fail(specification)) << name;
  }
  specification.stages[1].name = "biaxial";
  EXPECT_TRUE(can_fail(specification));
}

TEST(ElementTable, ShearGivesTheDeviatorNoSign) {
  element::Row row;
  // The normal stresses of two packings differ by an accident, to either side.
  for (const double more : {1e3, -1e3}) {
    row.stress << -100e3 + more, -100e3, 0.0, 30e3, 0.0, 0.0;
    TableForm form;
    const std::vector<std::string> columns = element_columns(form, {});
    const auto q = static_cast<std::size_t>(std::ranges::find(columns, "q_Pa") - columns.begin());
    EXPECT_EQ(element_values(form, row)[q] > 0.0, more > 0.0);
    form.drives_shear = true;
    EXPECT_GT(element_values(form, row)[q], 60e3);
  }
  element::NamedTest test;
  test.name = "simple_shear";
  test.drive.amount = 0.05;
  EXPECT_TRUE(element::drives_shear(element::stage_of(test, element::Room::discs)));
  test.name = "biaxial";
  EXPECT_FALSE(element::drives_shear(element::stage_of(test, element::Room::discs)));
}

TEST(Undrained, PhaseTransformationIsWhereTheMeanStressTurns) {
  ElementResult result = with_stages({-1, element::k11});
  const UndrainedFigures dense = undrained_figures(result, undrained({100e3, 80e3, 60e3, 70e3, 150e3}));
  EXPECT_TRUE(dense.is_undrained);
  EXPECT_DOUBLE_EQ(dense.least_mean_stress, 60e3);
  EXPECT_DOUBLE_EQ(dense.strain_at_least, 0.02);
  EXPECT_DOUBLE_EQ(dense.transformation_angle, 22.0);
  EXPECT_DOUBLE_EQ(dense.largest_pore_pressure, 40e3);
  EXPECT_FALSE(dense.flows);
  const UndrainedFigures loose = undrained_figures(result, undrained({100e3, 50e3, 20e3, 5e3, 0.5e3}));
  EXPECT_TRUE(std::isnan(loose.transformation_angle));
  EXPECT_TRUE(loose.flows);
  const UndrainedFigures dilates = undrained_figures(result, undrained({100e3, 110e3, 130e3}));
  EXPECT_DOUBLE_EQ(dilates.least_mean_stress, 100e3);  // the start
  EXPECT_DOUBLE_EQ(dilates.strain_at_least, 0.0);
  EXPECT_DOUBLE_EQ(dilates.largest_pore_pressure, 0.0);
  EXPECT_TRUE(std::isnan(dilates.transformation_angle));
  EXPECT_FALSE(undrained_figures(with_stages({-1, -1}), undrained({100e3, 100e3})).is_undrained);
}

// An elastic law keeps p' but for rounding, 1e-10 of it, then the law dilates.
TEST(Undrained, RoundingIsNoPhaseTransformation) {
  ElementResult result = with_stages({-1, element::k11});
  result.curves = {undrained({200e3, 200e3 * (1.0 - 1e-10), 200e3, 250e3})};
  EXPECT_TRUE(std::isnan(undrained_figures(result, result.curves.front()).transformation_angle));
  const std::string text = undrained_summary(result);
  EXPECT_EQ(text.find("first row"), std::string::npos) << text;
  // 0.1 % below the start is a turn.
  EXPECT_DOUBLE_EQ(
      undrained_figures(result, undrained({200e3, 199.9e3, 199.8e3, 250e3})).transformation_angle, 22.0);
}

TEST(Undrained, ExtremesAreThoseOfAllUndrainedStages) {
  ElementResult result = with_stages({-1, element::k11, element::k11, -1});
  ElementCurve curve = undrained({100e3, 60e3, 110e3});  // u: 0, 40, -10 kPa
  curve.name = "sand";
  curve.rows.push_back({2.0, 1.0, 0.01, 0.0, 90e3, 15.0, 10e3});
  curve.rows.push_back({2.0, 2.0, 0.0, 0.0, 80e3, 10.0, 20e3});
  curve.rows.push_back({3.0, 1.0, 0.05, 0.0, 20e3, 40.0, 0.0});  // drained: its p' does not count
  result.stages[3].constraints = {
      element::component(element::Constraint::Kind::stress, element::k11, element::Constraint::Way::hold)};
  result.curves = {curve};
  const UndrainedFigures figures = undrained_figures(result, curve);
  EXPECT_DOUBLE_EQ(figures.largest_pore_pressure, 40e3);
  EXPECT_DOUBLE_EQ(figures.least_mean_stress, 60e3);
  EXPECT_DOUBLE_EQ(figures.strain_at_least, 0.01);
  EXPECT_DOUBLE_EQ(figures.transformation_angle,
                   21.0);  // the second stage falls from 110 kPa and does not turn
  EXPECT_FALSE(figures.flows);
  const std::string text = undrained_summary(result);
  EXPECT_NE(text.find("sand: drained stage 3 keeps the p' of 80 kPa that the undrained one left of 100 kPa"),
            std::string::npos)
      << text;
  result.stages[3].constraints.clear();  // all stresses are prescribed anew
  EXPECT_EQ(undrained_summary(result).find("drained stage 3"), std::string::npos);
}

TEST(ElementSummary, APackingMadeUnderAnotherStressHasNoPeakBeforeTheTest) {
  std::vector<ElementResult> results;
  const std::vector<double> pressures{100e3, 200e3};
  for (const double pressure : pressures) {
    ElementResult result;
    result.columns = {"stage",  "row",    "axial_strain",       "volume_strain", "e12",
                      "s11_Pa", "s22_Pa", "friction_angle_deg", "jumps"};
    ElementCurve curve;
    curve.name = "sand";
    double stage = 0.0;
    for (const double angle : {40.0, 0.0, 30.0, 25.0}) {
      const StressCircle circle = at_limit(pressure, angle * kDegree, 0.0);
      curve.rows.push_back({stage, 1.0, 0.01 * stage, 0.0, 0.0, -circle.least, -circle.largest, angle, 0.0});
      stage += 1.0;
    }
    result.curves = {curve};
    results.push_back(result);
  }
  const std::string text = summary_of(results.front());
  EXPECT_NE(text.find(" 30.00 "), std::string::npos) << text;
  EXPECT_EQ(text.find("40.00"), std::string::npos) << text;
  const Envelopes envelopes = envelopes_of(results, pressures);
  EXPECT_NEAR(envelopes.at_states.front().second.front().line->friction_angle / kDegree, 30.0, 1e-9);
}

TEST(Undrained, AnExtremeInTheFirstRowAsksForMoreRows) {
  ElementResult result = with_stages({-1, element::k11});
  result.curves = {undrained({100e3, 80e3, 90e3, 150e3})};
  const std::string text = undrained_summary(result);
  EXPECT_NE(text.find("the least p' falls into the first row; the rows are too few to see it"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("the largest u falls into the first row"), std::string::npos) << text;
  result.curves = {undrained({100e3, 80e3, 60e3, 150e3})};
  EXPECT_EQ(undrained_summary(result).find("first row"), std::string::npos);
}

}  // namespace
}  // namespace polargrain::app
