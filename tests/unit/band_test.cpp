// SPDX-License-Identifier: GPL-2.0-or-later
// The band detector on fields whose band is known.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>
#include <random>

#include "band/local_strain.hpp"
#include "band/shear_band.hpp"

namespace {

using namespace polargrain::band;
using Eigen::Vector2d;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSpacing = 0.01;
constexpr double kWidth = 0.25;
constexpr double kHeight = 0.5;

/// Points on a square lattice, each shaken by a third of the spacing: 25 x 50.
std::vector<Vector2d> shaken_points() {
  std::mt19937 random(20011);
  std::uniform_real_distribution<double> shake(-kSpacing / 3.0, kSpacing / 3.0);
  std::vector<Vector2d> points;
  for (double y = 0.5 * kSpacing; y < kHeight; y += kSpacing)
    for (double x = 0.5 * kSpacing; x < kWidth; x += kSpacing)
      points.emplace_back(x + shake(random), y + shake(random));
  return points;
}

/// A band of Gaussian profile through the middle of the body.
struct Truth {
  double inclination = 58.0 * kDegree;
  double thickness = 0.08;  // full width at half maximum
  double peak = 0.2;
  double background = 0.02;

  [[nodiscard]] double distance(const Vector2d& x) const {
    return -std::sin(inclination) * (x.x() - 0.5 * kWidth) + std::cos(inclination) * (x.y() - 0.48 * kHeight);
  }
  [[nodiscard]] double deviation() const { return thickness / 2.354820045; }
  [[nodiscard]] double shear(const Vector2d& x) const {
    const double z = distance(x) / deviation();
    return background + (peak - background) * std::exp(-0.5 * z * z);
  }
};

/// @param noise standard deviation of the factor's logarithm
Samples samples_of(const Truth& truth, double noise = 0.0, unsigned seed = 10007) {
  std::mt19937 random(seed);
  std::normal_distribution<double> factor(0.0, noise > 0.0 ? noise : 1.0);
  Samples samples;
  for (const Vector2d& x : shaken_points()) {
    Sample sample;
    sample.position = x;
    sample.area = kSpacing * kSpacing;
    sample.shear = truth.shear(x) * (noise > 0.0 ? std::exp(factor(random)) : 1.0);
    sample.rotation = std::abs(truth.distance(x)) < 0.5 * truth.thickness ? -0.1 : 0.0;
    samples.push_back(sample);
  }
  return samples;
}

TEST(Band, WidthAndInclinationOfAKnownBand) {
  for (const double degrees : {-61.0, 35.0, 45.0, 58.0, 65.3}) {
    Truth truth;
    truth.inclination = degrees * kDegree;
    const BandSearch search = find_band(samples_of(truth));
    ASSERT_TRUE(search.band) << search.reason;
    const Band& band = *search.band;
    const double expected = std::hypot(truth.thickness, band.resolution);
    std::cout << "[figure] band of " << degrees << " degrees: " << band.inclination / kDegree
              << " degrees, thickness / exact " << band.thickness / expected << ", centre off "
              << truth.distance(band.centre) / truth.thickness << " thicknesses\n";
    // The samples are a spacing apart and shaken: a tenth of a spacing over the half length of the band, 0.2
    // degrees; the profile is steps of a quarter of a spacing.
    EXPECT_NEAR(band.inclination / kDegree, degrees, 0.3);
    EXPECT_NEAR(band.thickness / expected, 1.0, 0.03);
    EXPECT_NEAR(truth.distance(band.centre), 0.0, 0.1 * kSpacing);
    EXPECT_NEAR(band.peak, truth.peak, 0.03 * truth.peak);
    EXPECT_NEAR(band.background, truth.background, 0.5 * truth.background);
  }
}

TEST(Band, NoiseOfGrainsMovesItLittle) {
  // Grains scatter: a factor of exp(+-0.6) on every sample.
  double greatest_turn = 0.0;
  double greatest_width = 0.0;
  for (unsigned seed = 10007; seed < 10017; ++seed) {
    const Truth truth;
    const BandSearch search = find_band(samples_of(truth, 0.6, seed));
    ASSERT_TRUE(search.band) << search.reason;
    greatest_turn = std::max(greatest_turn, std::abs(search.band->inclination - truth.inclination) / kDegree);
    greatest_width = std::max(greatest_width, std::abs(search.band->thickness / truth.thickness - 1.0));
  }
  std::cout << "[figure] scatter of 0.6 in the logarithm, ten fields: inclination off by at most "
            << greatest_turn << " degrees, thickness by " << 100.0 * greatest_width << " %\n";
  // 400 samples in the band of half width 0.04 m and length 0.3 m: 0.04 / sqrt(400) * sqrt(12) / 0.3 * 0.66 =
  // 0.9 degrees is one standard deviation; three of them. The peak, which half of is taken, is the greatest
  // of noisy values: its error (0.66 / sqrt(30) = 12 %) moves the width by about as much.
  EXPECT_LT(greatest_turn, 2.7);
  EXPECT_LT(greatest_width, 0.3);
}

// Damaged results: no number of theirs ends the search, nor makes it endless.
TEST(Band, SaysWhatIsWrongWithItsSamples) {
  const Samples good = samples_of(Truth{});
  const auto reason = [&good](const auto& spoil) {
    Samples samples = good;
    spoil(samples);
    return find_band(samples).reason;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(reason([](Samples& s) { s[3].area = 0.0; }), "a sample has no area, or no strain");
  EXPECT_EQ(reason([&](Samples& s) { s[3].shear = nan; }), "a sample has no area, or no strain");
  EXPECT_EQ(reason([&](Samples& s) { s[3].position.x() = nan; }), "a sample has no area, or no strain");
  EXPECT_EQ(reason([](Samples& s) { s[3].position.x() = 1e9; }), "the samples span no area");
}

TEST(Band, SaysThatThereIsNone) {
  Truth truth;
  truth.peak = truth.background;
  EXPECT_FALSE(find_band(samples_of(truth)).band);
  for (unsigned seed = 10007; seed < 10017; ++seed) {
    const BandSearch search = find_band(samples_of(truth, 0.6, seed));
    EXPECT_FALSE(search.band) << "in pure noise";
    EXPECT_FALSE(search.reason.empty());
  }
  // Wider than the body: nothing falls to half.
  truth = Truth{};
  truth.thickness = 2.0;
  EXPECT_FALSE(find_band(samples_of(truth)).band);
  // A faint one.
  truth = Truth{};
  truth.peak = 1.5 * truth.background;
  const BandSearch faint = find_band(samples_of(truth));
  EXPECT_FALSE(faint.band);
  EXPECT_NE(faint.reason.find("times the background"), std::string::npos) << faint.reason;
  EXPECT_TRUE(find_band(samples_of(truth), {.contrast = 1.2}).band) << "it is there to be found";
  EXPECT_FALSE(find_band({}).band);
}

TEST(Band, RotationsInsideAndOutside) {
  const Samples samples = samples_of(Truth{});
  const BandSearch search = find_band(samples);
  ASSERT_TRUE(search.band);
  const InsideOutside rotation = means(samples, *search.band, &Sample::rotation);
  // The band found is wider than the true one by the resolution: 1 % of its samples lie in the rim.
  EXPECT_NEAR(rotation.inside, -0.1, 0.005);
  EXPECT_EQ(rotation.outside, 0.0);
}

TEST(LocalStrain, AffineFieldIsExact) {
  Eigen::Matrix2d gradient;
  gradient << 0.01, -0.02, 0.03, -0.04;
  const std::vector<Vector2d> points = shaken_points();
  std::vector<Vector2d> displacements;
  for (const Vector2d& x : points) displacements.push_back(gradient * x + Vector2d(1.0, 2.0));
  for (const Eigen::Matrix2d& found : displacement_gradients(points, displacements, 2.5 * kSpacing))
    ASSERT_LT((found - gradient).cwiseAbs().maxCoeff(), 1e-12);  // round-off of the shift over the spacing
  // |h11 - h22| = 0.05, h12 + h21 = 0.01.
  EXPECT_NEAR(shear_strain(gradient), std::hypot(0.05, 0.01), 1e-15);
}

TEST(LocalStrain, LonelyPointsHaveNoStrain) {
  const std::vector<Vector2d> points{{0.0, 0.0}, {0.001, 0.0}, {0.002, 0.0}};
  for (const Eigen::Matrix2d& found :
       displacement_gradients(points, {{0.0, 0.0}, {0.0, 1.0}, {0.0, 2.0}}, 0.01))
    EXPECT_TRUE(std::isnan(found(0, 0))) << "points in one line";
}

TEST(LocalStrain, BandOfDisplacementsIsFoundAtItsWidth) {
  // Grains that slide along a band: u = e U erf(s / (sqrt 2 deviation)) / 2, on top of a compression.
  const Truth truth;
  const double slide =
      (truth.peak - truth.background) * truth.deviation() * std::sqrt(2.0 * std::numbers::pi);
  const Vector2d direction(std::cos(truth.inclination), std::sin(truth.inclination));
  const std::vector<Vector2d> points = shaken_points();
  std::vector<Vector2d> displacements;
  for (const Vector2d& x : points)
    displacements.push_back(-0.5 * slide * std::erf(truth.distance(x) / truth.deviation() / std::sqrt(2.0)) *
                                direction +
                            Vector2d(0.01 * x.x(), -0.01 * x.y()));
  const double radius = 2.5 * kSpacing;
  const std::vector<Eigen::Matrix2d> gradients = displacement_gradients(points, displacements, radius);
  Samples samples;
  for (std::size_t k = 0; k < points.size(); ++k)
    samples.push_back(
        {points[k], kSpacing * kSpacing, shear_strain(gradients[k]), gradients[k].trace(), 0.0});
  const BandSearch search = find_band(samples);
  ASSERT_TRUE(search.band) << search.reason;
  const double expected = std::sqrt(std::pow(truth.thickness, 2) + std::pow(filter_width(radius), 2) +
                                    std::pow(search.band->resolution, 2));
  std::cout << "[figure] band of displacements: " << search.band->inclination / kDegree << " degrees of "
            << truth.inclination / kDegree << ", thickness / expected " << search.band->thickness / expected
            << ", / true " << search.band->thickness / truth.thickness << "\n";
  EXPECT_NEAR(search.band->inclination / kDegree, truth.inclination / kDegree, 0.5);
  // The shear of band and compression are added as vectors, so that the profile is not quite Gaussian.
  EXPECT_NEAR(search.band->thickness / expected, 1.0, 0.05);
}

TEST(Onset, IsWhereTheLastRiseCrossesTheThreshold) {
  const std::vector<double> strains{0.005, 0.015, 0.025, 0.035, 0.045};
  EXPECT_DOUBLE_EQ(*onset_strain(strains, {1.0, 1.2, 1.6, 2.4, 4.0}), 0.03);
  EXPECT_DOUBLE_EQ(*onset_strain(strains, {1.0, 3.0, 1.5, 2.5, 4.0}), 0.03) << "a first rise that fell back";
  EXPECT_DOUBLE_EQ(*onset_strain(strains, {2.0, 3.0, 3.0, 3.0, 3.0}), 0.005);
  EXPECT_FALSE(onset_strain(strains, {1.0, 3.0, 3.0, 3.0, 1.9}));
  EXPECT_FALSE(onset_strain({}, {}));
}

TEST(Onset, OfABandThatGrows) {
  // Localisation of the increments follows from the contrast; background 0.02, peak grows.
  std::vector<double> strains;
  std::vector<double> localisations;
  Truth last;
  const Band band = *find_band(samples_of(last)).band;
  for (int k = 0; k < 20; ++k) {
    Truth truth;
    truth.peak = truth.background * (1.0 + 0.25 * k);
    strains.push_back(0.0025 + 0.005 * k);
    localisations.push_back(localisation(samples_of(truth, 0.4, 10007 + static_cast<unsigned>(k)), band));
  }
  const std::optional<double> onset = onset_strain(strains, localisations);
  ASSERT_TRUE(onset);
  // The mean of a Gaussian over its half-maximum width is 0.81 of its peak (erf(sqrt(ln 2)) / sqrt(ln 2) *
  // sqrt(pi) / 2); the tails beyond one thickness are 0.02 of the peak over the body. 1 + 0.81 * 0.25 k = 2
  // (1 + 0.02 * 0.25 k) at k = 5.2: strain 0.0285.
  std::cout << "[figure] onset of a growing band: " << *onset << " (0.0285 expected)\n";
  EXPECT_NEAR(*onset, 0.0285, 0.005);  // one increment
}

}  // namespace
