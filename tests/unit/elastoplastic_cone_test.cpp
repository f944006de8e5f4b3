// SPDX-License-Identifier: GPL-2.0-or-later
// Matching of the cone to Mohr-Coulomb strengths and the tabulated strengths.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/error.hpp"
#include "fem/material/cone_matching.hpp"

namespace polargrain::fem {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(ConeMatching, WorkedExampleOfTheory) {
  // docs/theory/plasticity.md, B.3: phi = 40, psi = 10 degrees, given to five decimals.
  const FrozenCone cone = cone_from_plane_strain({40.0, 10.0, 0.0});
  EXPECT_NEAR(cone.dilatancy, 0.29927, 5e-6);
  EXPECT_NEAR(cone.friction, 1.07878, 5e-6);
  EXPECT_NEAR(cone_from_triaxial_compression({40.0, 10.0, 0.0}).friction, 1.63614, 5e-6);
}

TEST(ConeMatching, WithoutDilatancyFrictionIsRootThreeSine) {
  for (const double phi : {0.0, 5.0, 30.0, 60.0, 89.0}) {
    const FrozenCone cone = cone_from_plane_strain({phi, 0.0, 2e3});
    EXPECT_NEAR(cone.friction, std::sqrt(3.0) * std::sin(phi * kDegree), 1e-15);
    EXPECT_NEAR(cone.cohesion, std::sqrt(3.0) * 2e3 * std::cos(phi * kDegree), 1e-11);
  }
}

TEST(ConeMatching, AssociatedFlowGivesTheClassicalPlaneStrainCone) {
  for (const double phi : {1.0, 20.0, 35.0, 50.0}) {
    const FrozenCone cone = cone_from_plane_strain({phi, phi, 0.0});
    const double tangent = std::tan(phi * kDegree);
    const double classical = 3.0 * std::sqrt(3.0) * tangent / std::sqrt(9.0 + 12.0 * tangent * tangent);
    EXPECT_NEAR(cone.friction, classical, 1e-14);
    EXPECT_NEAR(cone.dilatancy, classical, 1e-14);
  }
}

TEST(ConeMatching, InverseGivesTheStrengthBack) {
  for (const double phi : {5.0, 25.0, 40.0, 55.0}) {
    for (const double psi : {-15.0, 0.0, 5.0, 20.0}) {
      const auto back = plane_strain_from_cone(cone_from_plane_strain({phi, psi, 1.5e3}));
      ASSERT_TRUE(back);
      EXPECT_NEAR(back->friction_angle, phi, 1e-11);
      EXPECT_NEAR(back->dilatancy_angle, psi, 1e-11);
      EXPECT_NEAR(back->cohesion, 1.5e3, 1e-8);
    }
  }
}

TEST(ConeMatching, CompressionConeHasNoPlaneStrainCollapseBeyond42Degrees) {
  // B.3: at phi = 40 the plane-strain angle is 70.8 degrees; from 42.2 (M = sqrt 3) there is no collapse.
  const auto at40 = plane_strain_from_cone(cone_from_triaxial_compression({40.0, 0.0, 0.0}));
  ASSERT_TRUE(at40);
  EXPECT_NEAR(at40->friction_angle, 70.8, 0.05);
  EXPECT_TRUE(plane_strain_from_cone(cone_from_triaxial_compression({42.1, 0.0, 0.0})));
  EXPECT_FALSE(plane_strain_from_cone(cone_from_triaxial_compression({42.3, 0.0, 0.0})));
  EXPECT_FALSE(plane_strain_from_cone({1.0, 3.0, 0.0}));
}

TEST(ConeMatching, TriaxialConesTouchTheirCorners) {
  // At s1 = s2 = -a, s3 = -b (b > a: compression) Mohr-Coulomb reads b (1 - sin) = a (1 + sin) + 2 c cos.
  const double phi = 32.0;
  const double c = 3e3;
  const double a = 50e3;
  const double s = std::sin(phi * kDegree);
  const double b = (a * (1.0 + s) + 2.0 * c * std::cos(phi * kDegree)) / (1.0 - s);
  const FrozenCone compression = cone_from_triaxial_compression({phi, 0.0, c});
  const FrozenCone extension = cone_from_triaxial_extension({phi, 0.0, c});
  const double rounding = 1e-9;  // Pa, of stresses of 1e5 Pa
  EXPECT_NEAR((b - a) - compression.friction * (2.0 * a + b) / 3.0 - compression.cohesion, 0.0, rounding);
  EXPECT_NEAR((b - a) - extension.friction * (2.0 * b + a) / 3.0 - extension.cohesion, 0.0, rounding);
}

TEST(ConeMatching, RefusesWhatIsNotAStrength) {
  EXPECT_THROW(cone_from_plane_strain({90.0, 0.0, 0.0}), InputError);
  EXPECT_THROW(cone_from_plane_strain({-1.0, 0.0, 0.0}), InputError);
  EXPECT_THROW(cone_from_plane_strain({30.0, 90.0, 0.0}), InputError);
  EXPECT_THROW(cone_from_plane_strain({30.0, 0.0, -1.0}), InputError);
  EXPECT_THROW(cone_from_triaxial_compression({NAN, 0.0, 0.0}), InputError);
  try {
    cone_from_plane_strain({95.0, 0.0, -2.0});
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 2U);  // all faults at once
    EXPECT_NE(error.faults()[0].message.find("95"), std::string::npos);
    EXPECT_NE(error.faults()[0].message.find("[0, 90)"), std::string::npos);
  }
}

TEST(HardeningConeMatching, KnotsOfOneFunctionBecomeKnotsOfAll) {
  const HardeningCone cone = hardening_cone_from_plane_strain(
      {PiecewiseLinear::ramp(40.0, 32.0, 0.1), PiecewiseLinear::ramp(10.0, 0.0, 0.05), 1e3});
  EXPECT_EQ(cone.friction.knots().size(), 3U);
  for (const double gamma_p : {0.0, 0.05, 0.1, 0.3}) {
    const double phi = 40.0 - 8.0 * std::min(gamma_p, 0.1) / 0.1;
    const double psi = 10.0 - 10.0 * std::min(gamma_p, 0.05) / 0.05;
    const FrozenCone expected = cone_from_plane_strain({phi, psi, 1e3});
    EXPECT_NEAR(cone(gamma_p).friction, expected.friction, 1e-14);
    EXPECT_NEAR(cone(gamma_p).dilatancy, expected.dilatancy, 1e-14);
    EXPECT_NEAR(cone(gamma_p).cohesion, expected.cohesion, 1e-10);
  }
}

TEST(PiecewiseLinear, ValuesSlopesAndFloor) {
  const PiecewiseLinear ramp = PiecewiseLinear::ramp(10.0, 4.0, 0.2);
  EXPECT_DOUBLE_EQ(ramp.at(0.0).value, 10.0);
  EXPECT_DOUBLE_EQ(ramp.at(0.1).value, 7.0);
  EXPECT_DOUBLE_EQ(ramp.at(0.1).slope, -30.0);
  EXPECT_DOUBLE_EQ(ramp.at(0.0).slope, -30.0);
  EXPECT_DOUBLE_EQ(ramp.at(0.2).value, 4.0);
  EXPECT_DOUBLE_EQ(ramp.at(0.2).slope, 0.0);  // the slope of the piece that loading enters
  EXPECT_DOUBLE_EQ(ramp.at(5.0).value, 4.0);
  const PiecewiseLinear table({{0.1, 1.0}, {0.2, 3.0}, {0.4, 2.0}});
  EXPECT_DOUBLE_EQ(table.at(0.0).value, 1.0);
  EXPECT_DOUBLE_EQ(table.at(0.0).slope, 0.0);
  EXPECT_DOUBLE_EQ(table.at(0.15).value, 2.0);
  EXPECT_DOUBLE_EQ(table.at(0.3).slope, -5.0);
}

TEST(PiecewiseLinear, RefusesTablesOutOfOrder) {
  EXPECT_THROW(PiecewiseLinear(std::vector<PiecewiseLinear::Knot>{}), InputError);
  EXPECT_THROW(PiecewiseLinear({{0.0, 1.0}, {0.0, 2.0}}), InputError);
  EXPECT_THROW(PiecewiseLinear({{0.1, 1.0}, {0.05, 2.0}}), InputError);
  EXPECT_THROW(PiecewiseLinear({{0.0, 1.0}, {0.1, NAN}}), InputError);
  EXPECT_THROW(PiecewiseLinear::ramp(1.0, 0.0, 0.0), InputError);
}

}  // namespace
}  // namespace polargrain::fem
