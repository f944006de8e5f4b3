// SPDX-License-Identifier: GPL-2.0-or-later
// How a micro scale answers inside of the cone (fem/material/unloading.hpp).
#include "fem/material/unloading.hpp"

#include <gtest/gtest.h>

#include "fem/material/elastic.hpp"
#include "fem/material/mobilisation.hpp"
#include "tests/support/subspace_moduli.hpp"

namespace polargrain::fem::test {
namespace {

ScaledVector<double> strain() {
  ScaledVector<double> strain;
  strain << 4e-4, -9e-4, 0.0, 3e-4, 1e-4, 2e-4, -5e-4;
  return strain;
}

/// Of a micro scale that is softer than the elasticity by a share, and contracts by a part of its shear.
ScaledVector<double> soft_stress(double stiffness, double contraction) {
  const Split<double> split(strain());
  ScaledVector<double> stress = ScaledVector<double>::Zero();
  double squares = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    stress += stiffness * moduli().stiffness[k] * split.part[k];
    squares += split.part[k].squaredNorm();
  }
  return stress +
         moduli().bulk * (3.0 * split.mean - contraction * std::sqrt(squares)) * volumetric_vector<double>();
}

TEST(Unloading, WhatAMicroScaleShowsIsWhatTheLawFeels) {
  const auto mode = unloading_mode(moduli(), strain(), soft_stress(0.4, -0.2));
  ASSERT_TRUE(mode);
  EXPECT_NEAR(mode->stiffness, 0.4, 1e-12);
  EXPECT_NEAR(mode->contraction, -0.2, 1e-12);
  const UnloadingMode::Felt felt = mode->felt(strain(), 3);
  const ScaledVector<double> expected = soft_stress(0.4, -0.2);
  EXPECT_LT((elastic_stress(moduli(), felt.strain) - expected).norm(), 1e-12 * expected.norm());
}

TEST(Unloading, TheSlopeIsThatOfTheStrainThatIsFelt) {
  const UnloadingMode mode{0.3, 0.25};
  for (const std::size_t parts : {1u, 3u}) {
    const ScaledMatrix<double> slope = mode.felt(strain(), parts).slope;
    for (int j = 0; j < 7; ++j) {
      constexpr double kStep = 1e-7;
      ScaledVector<double> plus = strain(), minus = strain();
      plus(j) += kStep;
      minus(j) -= kStep;
      const ScaledVector<double> found =
          (mode.felt(plus, parts).strain - mode.felt(minus, parts).strain) / (2.0 * kStep);
      // The norm of the strain is 1e-3: its third derivative times the step squared over six.
      EXPECT_LT((found - slope.col(j)).norm(), 1e-7) << parts << ' ' << j;
    }
  }
}

TEST(Unloading, WhatTheMicroScaleDoesNotFeelStaysElastic) {
  const Split<double> felt(UnloadingMode{0.3, 0.25}.felt(strain(), 1).strain);
  const Split<double> split(strain());
  EXPECT_LT((felt.part[0] - 0.3 * split.part[0]).norm(), 1e-18);
  EXPECT_LT((felt.part[1] - split.part[1]).norm(), 1e-18);
  EXPECT_LT((felt.part[2] - split.part[2]).norm(), 1e-18);
}

TEST(Unloading, IsKeptWithinWhatAnElasticLawTakes) {
  EXPECT_EQ(unloading_mode(moduli(), strain(), soft_stress(-0.5, 0.0))->stiffness, 0.02);
  EXPECT_EQ(unloading_mode(moduli(), strain(), soft_stress(7.0, 0.0))->stiffness, 2.0);
  EXPECT_EQ(unloading_mode(moduli(), strain(), soft_stress(1.0, -9.0))->contraction, -1.0);
  EXPECT_FALSE(unloading_mode(moduli(), 1e-4 * volumetric_vector<double>(), soft_stress(1.0, 0.0)));
}

TEST(Unloading, IsReadWhereTheLawDoesNotFlowAndItsCellIsInsideOfTheCone) {
  const MobilisationOptions options;
  const ScaledVector<double> pressure = -100e3 * volumetric_vector<double>();
  MicroStep<2> step{strain(), pressure, pressure + soft_stress(0.4, 0.0), 0.0, false};
  Mobilisation<2> start = initial_mobilisation(options);
  EXPECT_FALSE(advance(start, step, moduli(), options).unloading) << "beyond the cone of no friction";
  start.cone.friction = 1.0;
  const Mobilisation<2> unloaded = advance(start, step, moduli(), options);
  ASSERT_TRUE(unloaded.unloading);
  EXPECT_NEAR(unloaded.unloading->stiffness, 0.4, 1e-12);
  step.macro_plastic = true;
  EXPECT_FALSE(advance(unloaded, step, moduli(), options).unloading);
}

}  // namespace
}  // namespace polargrain::fem::test
