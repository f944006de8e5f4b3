// SPDX-License-Identifier: GPL-2.0-or-later
// The detector of planes on fields whose plane is known.
#include "band/shear_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>
#include <random>

namespace {

using namespace polargrain::band;
using Eigen::Vector3d;

constexpr double kDegreeOfShearPlane = std::numbers::pi / 180.0;
constexpr double kSpacingOfShearPlane = 0.01;

/// A band of Gaussian profile near the middle of a body.
struct TruthOfShearPlane {
  Vector3d size{0.15, 0.15, 0.3};  ///< m, of the body; a cylinder where its sides say so
  bool is_round = false;
  double dip = 55.0;           ///< degrees
  double dip_direction = 0.0;  ///< degrees
  double thickness = 0.05;     ///< full width at half maximum
  Vector3d through{0.075, 0.075, 0.15};
  double peak = 0.2;
  double background = 0.02;

  [[nodiscard]] Vector3d normal() const {
    const double a = dip * kDegreeOfShearPlane;
    const double b = dip_direction * kDegreeOfShearPlane;
    return {std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
  }
  [[nodiscard]] double distance(const Vector3d& x) const { return normal().dot(x - through); }
};

/// Places on a cubic lattice, shaken by a third of the spacing. @param noise of the logarithm of each factor
SpaceSamples samples_of_plane(const TruthOfShearPlane& truth, double noise = 0.0, unsigned seed = 10007) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shake(-kSpacingOfShearPlane / 3.0, kSpacingOfShearPlane / 3.0);
  std::normal_distribution<double> factor(0.0, noise > 0.0 ? noise : 1.0);
  SpaceSamples samples;
  for (double z = 0.5 * kSpacingOfShearPlane; z < truth.size.z(); z += kSpacingOfShearPlane)
    for (double y = 0.5 * kSpacingOfShearPlane; y < truth.size.y(); y += kSpacingOfShearPlane)
      for (double x = 0.5 * kSpacingOfShearPlane; x < truth.size.x(); x += kSpacingOfShearPlane) {
        SpaceSample sample;
        sample.position = {x + shake(random), y + shake(random), z + shake(random)};
        if (truth.is_round && (sample.position - 0.5 * truth.size).head<2>().norm() > 0.5 * truth.size.x())
          continue;
        sample.volume = kSpacingOfShearPlane * kSpacingOfShearPlane * kSpacingOfShearPlane;
        const double s = truth.distance(sample.position) / (truth.thickness / 2.354820045);
        sample.shear = (truth.background + (truth.peak - truth.background) * std::exp(-0.5 * s * s)) *
                       (noise > 0.0 ? std::exp(factor(random)) : 1.0);
        sample.volume_strain = std::abs(truth.distance(sample.position)) < 0.5 * truth.thickness ? 0.03 : 0.0;
        samples.push_back(sample);
      }
  return samples;
}

/// Of two normals, degrees; the sign does not count.
double angle_between(const Vector3d& a, const Vector3d& b) {
  return std::asin(std::min(1.0, a.cross(b).norm())) / kDegreeOfShearPlane;
}

class KnownPlane : public ::testing::TestWithParam<TruthOfShearPlane> {};

// The samples are a spacing apart and shaken; the profile is steps of a quarter of a spacing.
TEST_P(KnownPlane, NormalThicknessAndPlace) {
  const TruthOfShearPlane& truth = GetParam();
  const PlaneSearch search = find_plane(samples_of_plane(truth));
  ASSERT_TRUE(search.plane) << search.reason;
  const Plane& plane = *search.plane;
  const double expected = std::hypot(truth.thickness, plane.resolution);
  std::cout << "[figure] plane off by " << angle_between(plane.normal, truth.normal())
            << " degrees, thickness / exact " << plane.thickness / expected << ", off by "
            << truth.distance(plane.centre) / kSpacingOfShearPlane << " spacings\n";
  EXPECT_LT(angle_between(plane.normal, truth.normal()), 0.3);
  EXPECT_NEAR(plane.dip() / kDegreeOfShearPlane, truth.dip, 0.3);
  EXPECT_NEAR(plane.thickness / expected, 1.0, 0.04);
  EXPECT_NEAR(truth.distance(plane.centre), 0.0, 0.1 * kSpacingOfShearPlane);
  EXPECT_NEAR(plane.peak, truth.peak, 0.06 * truth.peak);  // half of the kernel's share of a thin band
  EXPECT_NEAR(plane.background, truth.background, 0.5 * truth.background);
  const InsideOutside dilation = means(samples_of_plane(truth), plane, &SpaceSample::volume_strain);
  EXPECT_NEAR(dilation.inside, 0.03, 0.006);
  EXPECT_EQ(dilation.outside, 0.0);
  EXPECT_GT(localisation(samples_of_plane(truth), plane), 4.0);
}

INSTANTIATE_TEST_SUITE_P(
    Planes, KnownPlane,
    ::testing::Values(
        TruthOfShearPlane{}, TruthOfShearPlane{.dip = 62.0, .dip_direction = 137.0},
        TruthOfShearPlane{.is_round = true, .dip = 48.0, .dip_direction = -71.0},
        // Unseen while the search was written.
        TruthOfShearPlane{.size = {0.3, 0.2, 0.1},
                          .dip = 35.0,
                          .dip_direction = 20.0,
                          .thickness = 0.04,
                          .through = {0.14, 0.11, 0.05}},
        TruthOfShearPlane{.is_round = true, .dip = 70.0, .dip_direction = 91.0, .thickness = 0.035},
        TruthOfShearPlane{.dip = 4.0, .dip_direction = -160.0, .through = {0.075, 0.075, 0.2}}));

// Grains scatter: a factor of exp(+-0.6) on every sample.
TEST(Plane, NoiseMovesItLittle) {
  for (unsigned seed = 10007; seed < 10010; ++seed) {
    const TruthOfShearPlane truth{.dip_direction = 33.0};
    const PlaneSearch search = find_plane(samples_of_plane(truth, 0.6, seed));
    ASSERT_TRUE(search.plane) << search.reason;
    EXPECT_LT(angle_between(search.plane->normal, truth.normal()), 2.7);
    EXPECT_NEAR(search.plane->thickness / std::hypot(truth.thickness, search.plane->resolution), 1.0, 0.2);
  }
}

TEST(Plane, SaysThatThereIsNone) {
  TruthOfShearPlane truth;
  truth.peak = truth.background;
  EXPECT_FALSE(find_plane(samples_of_plane(truth)).plane);
  EXPECT_FALSE(find_plane(samples_of_plane(truth, 0.6)).plane) << "in pure noise";
  truth = TruthOfShearPlane{};
  truth.peak = 1.5 * truth.background;
  EXPECT_NE(find_plane(samples_of_plane(truth)).reason.find("times the background"), std::string::npos);
  truth = TruthOfShearPlane{};
  truth.thickness = 2.0;
  EXPECT_FALSE(find_plane(samples_of_plane(truth)).plane) << "wider than the body";
  EXPECT_FALSE(find_plane({}).plane);
  SpaceSamples samples = samples_of_plane(TruthOfShearPlane{});
  samples[3].shear = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(find_plane(samples).reason, "a sample has no volume, or no strain");
}

TEST(Plane, ShearIsTheDifferenceOfExtremePrincipalStrains) {
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  gradient(0, 2) = 0.3;  // simple shear
  EXPECT_NEAR(shear_strain(gradient), 0.3, 1e-15);
  gradient = Eigen::Vector3d(0.01, 0.02, -0.05).asDiagonal();
  EXPECT_NEAR(shear_strain(gradient), 0.07, 1e-15);
}

}  // namespace
