// SPDX-License-Identifier: GPL-2.0-or-later
// Following a micro scale through loading, unloading and softening (docs/theory/plasticity.md, B.9).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fem/material/cone_matching.hpp"
#include "fem/material/mobilisation.hpp"
#include "tests/support/subspace_moduli.hpp"

namespace polargrain::fem::test {
namespace {

constexpr double kMean = -100e3;  // Pa

/// Pure shear of the plane under kMean: q = sqrt(3) tau.
ScaledVector<double> stress(double mu) {
  ScaledVector<double> s = ScaledVector<double>::Zero();
  s.head<3>().setConstant(kMean);
  s(k12) = s(k21) = -mu * kMean / std::sqrt(3.0);
  return s;
}

/// An increment in which the micro scale goes from one friction to another, with `plastic` shear (d gamma_p)
/// in the direction of the stress (or against it) and the given dilatancy.
MicroStep<2> step(double from, double to, double plastic, double dilatancy = 0.0) {
  MicroStep<2> step{};
  step.stress_before = stress(from);
  step.stress_after = stress(to);
  ScaledVector<double> strain = ScaledVector<double>::Zero();
  strain.head<3>().setConstant(dilatancy * std::abs(plastic) / 3.0);
  strain(k12) = strain(k21) = 0.5 * std::sqrt(3.0) * plastic +
                              (step.stress_after(k12) - step.stress_before(k12)) / moduli().stiffness[0];
  step.strain = strain;
  step.macro_mean = kMean;
  step.macro_plastic = true;
  return step;
}

MobilisationOptions options(int window) {
  MobilisationOptions options;
  options.window = window;
  return options;
}

TEST(Mobilisation, GrainsOutOfContactArePressedTogetherAgain) {
  MobilisationOptions with_drift = options(3);
  with_drift.drift_shear = 0.01;
  Mobilisation<2> point = initial_mobilisation(with_drift);
  point = advance(point, step(0.6, 0.6, 1e-3, 0.2), moduli(), with_drift);
  ASSERT_NEAR(point.cone.friction, 0.6, 1e-12);
  ASSERT_NEAR(point.cone.dilatancy, 0.2, 1e-12);
  // The rest of their stress, a hundredth, has a high friction, which must not count.
  MicroStep<2> apart = step(0.6, 0.6, 1e-3, 0.2);
  apart.stress_after = 0.01 * stress(3.0);
  point = advance(point, apart, moduli(), with_drift);
  EXPECT_NEAR(point.cone.friction, 0.6, 1e-12);
  EXPECT_NEAR(point.cone.dilatancy, std::max(-0.5, 0.99 * kMean / (moduli().bulk * 0.01)), 1e-12);
  EXPECT_LT(point.cone.dilatancy, 0.0);
  EXPECT_TRUE(point.limited);
  // In contact again, with less friction than before: it is on its way up, the law keeps its own.
  MicroStep<2> again = step(0.0, 0.4, 1e-3, 0.2);
  again.stress_before = apart.stress_after;
  point = advance(point, again, moduli(), with_drift);
  EXPECT_NEAR(point.cone.friction, 0.6, 1e-12);
  EXPECT_NEAR(point.cone.dilatancy, 0.0, 1e-12);
  point = advance(point, step(0.4, 0.3, 1e-3, 0.2), moduli(), with_drift);
  EXPECT_NEAR(point.cone.friction, 0.6, 1e-12);
  EXPECT_NEAR(point.cone.dilatancy, 0.2, 1e-12);
  EXPECT_FALSE(point.limited);
  // Without a drift there is nothing to press with, and nothing that parts them further.
  MobilisationOptions without = options(3);
  without.drift_shear = 0.0;
  point = advance(point, apart, moduli(), without);
  EXPECT_EQ(point.cone.dilatancy, 0.0);
}

TEST(Mobilisation, ReadsFrictionAtTheEndAndDilatancyOverTheWindow) {
  Mobilisation<2> point = initial_mobilisation(options(3));
  EXPECT_EQ(point.cone.friction, 0.0);
  point = advance(point, step(0.6, 0.6, 1e-3, 0.2), moduli(), options(3));
  EXPECT_NEAR(point.cone.friction, 0.6, 1e-12);
  EXPECT_NEAR(point.cone.dilatancy, 0.2, 1e-12);
  // Equal increments: the slope of a line through 0.2, 0.2 and 0.5 by least squares, weights 3, 4, 3 of 10.
  point = advance(point, step(0.6, 0.6, 1e-3, 0.2), moduli(), options(3));
  point = advance(point, step(0.6, 0.6, 1e-3, 0.5), moduli(), options(3));
  EXPECT_NEAR(point.cone.dilatancy, 0.29, 2e-3);  // the last increment is a little longer, it dilates more
  EXPECT_EQ(point.samples.size(), 4U);
  for (int i = 0; i < 5; ++i) point = advance(point, step(0.6, 0.6, 1e-3, 0.5), moduli(), options(3));
  EXPECT_NEAR(point.cone.dilatancy, 0.5, 1e-12);
  EXPECT_EQ(point.samples.size(), 4U);
}

TEST(Mobilisation, StaysInUnloadingAndDoesNotFallOnTheWayBack) {
  Mobilisation<2> point = initial_mobilisation(options(5));
  point = advance(point, step(0.0, 0.8, 1e-3, 0.1), moduli(), options(5));
  point = advance(point, step(0.8, 0.3, -1e-4), moduli(), options(5));
  EXPECT_NEAR(point.cone.friction, 0.8, 1e-12);
  EXPECT_NEAR(point.micro_friction, 0.3, 1e-12);
  EXPECT_TRUE(point.samples.empty());
  // Loaded again, still below: the law may yield at 0.8, the micro scale is at 0.6 and rising.
  point = advance(point, step(0.3, 0.6, 1e-4), moduli(), options(5));
  EXPECT_NEAR(point.cone.friction, 0.8, 1e-12);
  point = advance(point, step(0.6, 0.85, 1e-4), moduli(), options(5));
  EXPECT_NEAR(point.cone.friction, 0.85, 1e-12);
}

TEST(Mobilisation, FallsWhenTheMicroScaleSoftensUnderLoad) {
  Mobilisation<2> point = initial_mobilisation(options(5));
  point = advance(point, step(0.0, 0.8, 1e-3), moduli(), options(5));
  point = advance(point, step(0.8, 0.75, 1e-3), moduli(), options(5));
  EXPECT_NEAR(point.cone.friction, 0.75, 1e-12);
}

TEST(Mobilisation, KeepsTheConeWhileTheLawIsElastic) {
  MobilisationOptions given = options(5);
  given.initial_friction = 0.1;
  const Mobilisation<2> start = initial_mobilisation(given);
  MicroStep<2> elastic = step(0.0, 0.8, 1e-3);
  elastic.macro_plastic = false;
  const Mobilisation<2> point = advance(start, elastic, moduli(), given);
  EXPECT_EQ(point.cone.friction, start.cone.friction);
  EXPECT_NEAR(point.micro_friction, 0.8, 1e-12);
}

TEST(Mobilisation, FlagsEveryLimit) {
  Mobilisation<2> start = initial_mobilisation(options(1));
  // Limits: -0.5 and 1, and never above friction.
  EXPECT_EQ(advance(start, step(0.0, 0.8, 1e-3, -0.7), moduli(), options(1)).cone.dilatancy, -0.5);
  EXPECT_TRUE(advance(start, step(0.0, 0.8, 1e-3, -0.7), moduli(), options(1)).limited);
  const Mobilisation<2> above = advance(start, step(0.0, 0.8, 1e-3, 0.9), moduli(), options(1));
  EXPECT_NEAR(above.cone.dilatancy, 0.8, 1e-12);
  EXPECT_TRUE(above.limited);
  EXPECT_FALSE(advance(start, step(0.0, 0.8, 1e-3, 0.7), moduli(), options(1)).limited);
  MicroStep<2> tension = step(0.0, 0.8, 1e-3);
  tension.stress_after = -tension.stress_after;
  EXPECT_TRUE(advance(start, tension, moduli(), options(1)).limited);
}

TEST(Mobilisation, ADriftOfTheMeanStressIsWorkedOff) {
  MobilisationOptions given = options(1);
  given.drift_shear = 0.02;
  MicroStep<2> compressed = step(0.6, 0.6, 1e-3, 0.1);
  compressed.macro_mean = kMean + 20e3;  // the micro scale is compressed more than the law
  const double expected = 0.1 + 20e3 / (moduli().bulk * 0.02);
  const Mobilisation<2> point = advance(initial_mobilisation(given), compressed, moduli(), given);
  EXPECT_NEAR(point.cone.dilatancy, expected, 1e-12);
  // The next step is expected to shear by 0.05, and must not overshoot.
  MicroStep<2> longer = step(0.6, 0.6, 0.05, 0.1);
  longer.macro_mean = compressed.macro_mean;
  EXPECT_NEAR(advance(initial_mobilisation(given), longer, moduli(), given).cone.dilatancy,
              0.1 + 20e3 / (moduli().bulk * 0.05), 1e-12);
}

}  // namespace
}  // namespace polargrain::fem::test
