// SPDX-License-Identifier: GPL-2.0-or-later
// Reading friction and dilatancy off a step whose cone is known (docs/theory/plasticity.md, B.9).
#include <gtest/gtest.h>

#include <iostream>

#include "fem/material/mobilised.hpp"
#include "tests/unit/elastoplastic_variants.hpp"

namespace polargrain::fem::test {
namespace {

/// A return to a frozen cone must show exactly that cone, for any weights of the invariants.
TEST(Mobilised, ShowsTheConeThatMadeTheStep) {
  double worst = 0.0;
  int read = 0;
  for (const InvariantWeights& weights : {InvariantWeights{}, kStatic, kKinematic}) {
    const SubspaceModuli moduli(sand_elasticity(), weights);
    RandomStates random(11);
    for (int i = 0; i < 400; ++i) {
      const FrozenCone cone{random.uniform(0.3, 1.3), random.uniform(-0.2, 0.3), 1e3};
      const ScaledVector<double> strain = random.strain();
      const ConeReturn<double> end = step(strain, 0.0, moduli, cone);
      const double mean = end.stress.head<3>().sum() / 3.0;
      // Close to zero mean stress friction is a quotient of rounding; a tenth of the strength is far enough.
      if (end.regime != Regime::smooth || mean > -1e4) {
        continue;
      }
      const auto shown =
          mobilised(moduli, end.stress, plastic_strain(moduli, strain, end.stress), cone.cohesion);
      ASSERT_TRUE(shown);
      ++read;
      worst = std::max({worst, std::abs(shown->friction - cone.friction),
                        std::abs(shown->dilatancy - cone.dilatancy) * end.gamma_increment / strain.norm()});
      EXPECT_FALSE(shown->clipped);
    }
  }
  std::cout << "[figure] mobilised friction and dilatancy against the cone: " << worst << ", " << read
            << " states\n";
  EXPECT_GT(read, 300);
  EXPECT_LE(worst, 1e-11);  // yield residual of 1e-13 of the trial stress over the mean stress
}

TEST(Mobilised, SaysNothingWhereThereIsNothingToRead) {
  const SubspaceModuli moduli(sand_elasticity(), {});
  ScaledVector<double> stress = ScaledVector<double>::Zero();
  ScaledVector<double> plastic = ScaledVector<double>::Zero();
  stress.head<3>() << -100e3, -300e3, -150e3;
  EXPECT_FALSE(mobilised(moduli, stress, plastic, 0.0));  // elastic
  EXPECT_FALSE(mobilised_in_plane(stress, plastic));
  plastic(0) = 1e-4;
  plastic(1) = -1e-4;
  EXPECT_TRUE(mobilised(moduli, stress, plastic, 0.0));
  EXPECT_TRUE(mobilised_in_plane(stress, plastic));
  EXPECT_FALSE(mobilised(moduli, -stress, plastic, 0.0));  // tension
  stress(0) = 1e3;
  EXPECT_FALSE(mobilised_in_plane(stress, plastic));  // a tensile principal stress
}

TEST(Mobilised, FlagsWhatItClips) {
  const SubspaceModuli moduli(sand_elasticity(), {});
  ScaledVector<double> stress = ScaledVector<double>::Zero();
  stress.head<3>() << -100e3, -300e3, -150e3;
  ScaledVector<double> plastic = ScaledVector<double>::Zero();
  plastic.head<3>() << 3e-4, -1e-4, 1e-4;
  const auto shown = mobilised(moduli, stress, plastic, 0.0, {-0.5, 0.6});
  ASSERT_TRUE(shown);
  EXPECT_TRUE(shown->clipped);
  EXPECT_EQ(shown->dilatancy, 0.6);
  const auto in_plane = mobilised_in_plane(stress, plastic, {-0.5, 0.6});
  ASSERT_TRUE(in_plane);
  EXPECT_TRUE(in_plane->clipped);
}

/// In the plane: sin(phi) = 1/2 and sin(psi) = 0.1 of a hand-made state, turned by 30 degrees.
TEST(Mobilised, InPlaneAnglesDoNotDependOnTheAxes) {
  const double turn = 2.0 * 3.14159265358979323846 / 6.0;
  const auto turned = [&](double mean, double radius) {
    ScaledVector<double> tensor = ScaledVector<double>::Zero();
    tensor(0) = mean + radius * std::cos(turn);
    tensor(1) = mean - radius * std::cos(turn);
    tensor(3) = tensor(4) = radius * std::sin(turn);
    return tensor;
  };
  const auto shown = mobilised_in_plane(turned(-100e3, 50e3), turned(1e-4, 1e-3));
  const FrozenCone expected = cone_from_plane_strain({30.0, 5.7391704772667867, 0.0});  // asin 0.5, asin 0.1
  ASSERT_TRUE(shown);
  EXPECT_NEAR(shown->friction, expected.friction, 1e-13);
  EXPECT_NEAR(shown->dilatancy, expected.dilatancy, 1e-13);
}

TEST(PlasticStrain, WithoutCosseratModulusTheSkewPartIsElastic) {
  ElasticParameters<2> elastic = sand_elasticity();
  elastic.cosserat_shear_modulus = 0.0;
  const SubspaceModuli moduli(elastic, {});
  ScaledVector<double> strain = ScaledVector<double>::Zero();
  strain(3) = 1e-3;
  strain(4) = -1e-3;
  EXPECT_EQ(plastic_strain(moduli, strain, ScaledVector<double>::Zero()).norm(), 0.0);
}

}  // namespace
}  // namespace polargrain::fem::test
