// SPDX-License-Identifier: GPL-2.0-or-later
// Failure envelopes and the figures of undrained tests, from curves that are known.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "app/element/envelope.hpp"
#include "app/element/undrained_figures.hpp"

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

ElementCurve undrained(const std::vector<double>& mean_stress) {
  ElementCurve curve;
  for (std::size_t k = 0; k < mean_stress.size(); ++k) {
    const auto row = static_cast<double>(k);
    curve.rows.push_back(
        {1.0, row, 0.01 * row, 0.0, mean_stress[k], 20.0 + row, mean_stress[0] - mean_stress[k]});
  }
  return curve;
}

TEST(Undrained, PhaseTransformationIsWhereTheMeanStressTurns) {
  ElementResult result;
  result.columns = {"stage", "row", "axial_strain", "e12", "p_Pa", "friction_angle_deg", "pore_pressure_Pa"};
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
  EXPECT_TRUE(std::isnan(dilates.transformation_angle));
  EXPECT_FALSE(undrained_figures(result, undrained({100e3, 100e3})).is_undrained);
}

}  // namespace
}  // namespace polargrain::app
