// SPDX-License-Identifier: GPL-2.0-or-later
// Drawn sizes follow their law.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "dem/pack/sizes.hpp"

namespace polargrain::dem {
namespace {

TEST(Sizes, RandomNumbersAreThoseOfTheGenerator) {
  // 9981545732273789042 is the 10,000th number that the C++ standard lays down for the default seed of
  // mt19937_64.
  RandomNumbers random(std::mt19937_64::default_seed);
  double value = 0.0;
  for (int k = 0; k < 10000; ++k) value = random.uniform();
  EXPECT_EQ(value, static_cast<double>(9981545732273789042ULL >> 11) * 0x1p-53);
}

TEST(Sizes, SieveCurveByMassIsMet) {
  SizeLaw law;
  law.kind = SizeLaw::Kind::sieve;
  law.radii = {1e-3, 2e-3, 4e-3};
  law.shares = {0.0, 0.3, 1.0};
  RandomNumbers random(1);
  std::vector<double> radii = draw_radii(law, 4000, random);
  double mass = 0.0;
  double below = 0.0;
  double below_middle = 0.0;
  for (const double radius : radii) {
    mass += radius * radius;
    if (radius < 2e-3) below += radius * radius;
    if (radius < 3e-3) below_middle += radius * radius;
  }
  std::printf("[figure] mass below the sieves: %.4f (0.3), %.4f (0.65)\n", below / mass, below_middle / mass);
  // One grain is drawn from each 4000th of the law: a grain of the largest weighs 1e-3 of it at most.
  EXPECT_NEAR(below / mass, 0.3, 2e-3);
  EXPECT_NEAR(below_middle / mass, 0.65, 2e-3);
  EXPECT_GE(*std::min_element(radii.begin(), radii.end()), 1e-3);
  EXPECT_LE(*std::max_element(radii.begin(), radii.end()), 4e-3);
}

TEST(Sizes, LognormalAndUniformHaveTheirMoments) {
  RandomNumbers random(2);
  SizeLaw law;
  law.kind = SizeLaw::Kind::lognormal;
  law.radii = {1e-6, 5e-3, 1.0};  // ends so far away that they cut nothing
  law.deviation = 0.3;
  double mean = 0.0;
  double square = 0.0;
  for (const double radius : draw_radii(law, 4000, random)) {
    mean += std::log(radius / 5e-3) / 4000;
    square += std::pow(std::log(radius / 5e-3), 2) / 4000;
  }
  EXPECT_NEAR(mean, 0.0, 1e-3);
  EXPECT_NEAR(std::sqrt(square), 0.3, 1e-3);  // stratified: the tails alone scatter
  SizeLaw uniform;
  uniform.radii = {3e-3, 7e-3};
  mean = 0.0;
  for (const double radius : draw_radii(uniform, 400, random)) mean += radius / 400;
  EXPECT_NEAR(mean, 5e-3, 4e-3 / 400);  // each grain within its 400th
}

TEST(Sizes, ListSharesAreByNumber) {
  SizeLaw law;
  law.kind = SizeLaw::Kind::list;
  law.radii = {1e-3, 2e-3};
  law.shares = {3.0, 1.0};
  RandomNumbers random(3);
  const std::vector<double> radii = draw_radii(law, 400, random);
  EXPECT_EQ(std::count(radii.begin(), radii.end(), 1e-3), 300);
}

}  // namespace
}  // namespace polargrain::dem
