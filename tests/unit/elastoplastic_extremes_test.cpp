// SPDX-License-Identifier: GPL-2.0-or-later
// Limits of the parameters: every one must give a finite answer on the cone with an exact tangent.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/unit/elastoplastic_variants.hpp"

namespace polargrain::fem::test {
namespace {

struct Worst {
  double tangent = 0.0;
  double residual = 0.0;
  int smooth = 0;
  int apex = 0;
  int evaluations = 0;
};

/// Goes through random states, asserts that all have an answer and returns the worst errors of tangent
/// (against the complex step, relative to max |D|) and yield function (relative to the trial state).
Worst sweep(const ElasticParameters<2>& elastic, const InvariantWeights& weights, const HardeningCone& cone,
            double stretch = 1.0) {
  const SubspaceModuli moduli(elastic, weights);
  const double stiffness = elastic_stiffness(moduli).cwiseAbs().maxCoeff();
  RandomStates random(42);
  Worst worst;
  for (int i = 0; i < 300; ++i) {
    const ScaledVector<double> strain = stretch * random.strain();
    const double gamma_p = random.gamma_p();
    const ScaledVector<double> trial = elastic_stress(moduli, strain);
    const ConeReturn<double> end = step(strain, gamma_p, moduli, cone);
    EXPECT_EQ(end.fault, ReturnFault::none) << "state " << i;
    EXPECT_TRUE(end.stress.allFinite());
    const ScaledMatrix<double> tangent = consistent_tangent(trial, end, moduli);
    const ScaledMatrix<double> reference = complex_step_tangent(strain, gamma_p, moduli, cone);
    worst.tangent = std::max(worst.tangent, (tangent - reference).cwiseAbs().maxCoeff() / stiffness);
    worst.residual = std::max(worst.residual, end.residual);
    worst.smooth += end.regime == Regime::smooth ? 1 : 0;
    worst.apex += end.regime == Regime::apex ? 1 : 0;
    worst.evaluations = std::max(worst.evaluations, end.evaluations);
  }
  return worst;
}

void report(const std::string& what, const Worst& worst) {
  std::cout << "[figure] " << what << ": tangent error " << worst.tangent << ", residual " << worst.residual
            << ", smooth " << worst.smooth << ", apex " << worst.apex << ", most evaluations "
            << worst.evaluations << '\n';
}

HardeningCone softening_sand() {
  return hardening_cone_from_plane_strain({PiecewiseLinear::ramp(40.0, 32.0, 0.3),
                                           PiecewiseLinear::ramp(10.0, 0.0, 0.3),
                                           PiecewiseLinear::ramp(100e3, 20e3, 0.3)});
}

constexpr double kTangentTolerance = 1e-10;   // rounding, see elastoplastic_return_test.cpp
constexpr double kResidualTolerance = 1e-12;  // the scalar solve stops at 1e-13

TEST(ElastoplasticExtremes, CosseratModulusFromZeroToTenThousandG) {
  for (const double ratio : {0.0, 1e-6, 1e-2, 1.0, 1e2, 1e4}) {
    for (const InvariantWeights& weights : {InvariantWeights{}, kStatic, kKinematic}) {
      ElasticParameters<2> elastic = sand_elasticity();
      elastic.cosserat_shear_modulus = ratio * SubspaceModuli(elastic, weights).shear();
      const Worst worst = sweep(elastic, weights, softening_sand());
      report("Gc/G = " + std::to_string(ratio) + ", a1 = " + std::to_string(weights.a1), worst);
      EXPECT_LE(worst.tangent, kTangentTolerance);
      EXPECT_LE(worst.residual, kResidualTolerance);
      EXPECT_GT(worst.smooth, 50);
      EXPECT_LE(worst.evaluations, 30);
    }
  }
}

TEST(ElastoplasticExtremes, NearlyIncompressible) {
  ElasticParameters<2> elastic = sand_elasticity();
  elastic.poisson_ratio = 0.499;
  for (const InvariantWeights& weights : {InvariantWeights{}, kKinematic}) {
    const Worst worst = sweep(elastic, weights, softening_sand());
    report("nu = 0.499", worst);
    EXPECT_LE(worst.tangent, kTangentTolerance);
    EXPECT_LE(worst.residual, kResidualTolerance);
    EXPECT_GT(worst.smooth, 30);
  }
}

TEST(ElastoplasticExtremes, AuxeticElasticity) {
  ElasticParameters<2> elastic = sand_elasticity();
  elastic.poisson_ratio = -0.5;
  const Worst worst = sweep(elastic, {}, softening_sand());
  report("nu = -0.5", worst);
  EXPECT_LE(worst.tangent, kTangentTolerance);
  EXPECT_LE(worst.residual, kResidualTolerance);
}

TEST(ElastoplasticExtremes, WithoutCohesion) {
  const HardeningCone cone = hardening_cone_from_plane_strain(
      {PiecewiseLinear::ramp(40.0, 32.0, 0.3), PiecewiseLinear::ramp(10.0, 0.0, 0.3), 0.0});
  for (const double stretch : {1e-6, 1.0, 10.0}) {
    const Worst worst = sweep(sand_elasticity(), kStatic, cone, stretch);
    report("c = 0, strain x " + std::to_string(stretch), worst);
    EXPECT_GT(worst.apex, 50);
    EXPECT_GT(worst.smooth, 50);
    EXPECT_LE(worst.tangent, kTangentTolerance);
    EXPECT_LE(worst.residual, kResidualTolerance);
  }
}

/// Trial states that creep up to the apex from the side; there q goes to zero with the cohesion of zero.
TEST(ElastoplasticExtremes, WithoutCohesionNextToTheApex) {
  const SubspaceModuli moduli(sand_elasticity(), kStatic);
  const HardeningCone cone{1.0, 0.2, 0.0};
  ScaledVector<double> shear;
  shear << 1e-3, -1e-3, 0.0, 5e-4, 2e-4, 1e-4, 0.0;
  const double apex_gamma = detail::apex_gamma_increment<double>(
      moduli, detail::YieldEquation<double, HardeningCone>(moduli, cone, 0.0,
                                                           Split<double>(elastic_stress(moduli, shear)))
                  .squared);
  for (const double away : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
    // The volume strain at which the switch to the apex happens is M_psi d lambda*.
    ScaledVector<double> strain = shear;
    strain.head<3>().array() += (0.2 * apex_gamma - away * 1e-3) / 3.0;
    const ConeReturn<double> end = step(strain, 0.0, moduli, cone);
    ASSERT_EQ(end.fault, ReturnFault::none);
    ASSERT_EQ(end.regime, Regime::smooth) << away;
    const ScaledMatrix<double> tangent = consistent_tangent(elastic_stress(moduli, strain), end, moduli);
    const double error = (tangent - complex_step_tangent(strain, 0.0, moduli, cone)).cwiseAbs().maxCoeff() /
                         elastic_stiffness(moduli).maxCoeff();
    std::cout << "[figure] c = 0, " << away << " from the apex: tangent error " << error << ", q "
              << deviatoric_stress(Split<double>(end.stress), moduli) << " Pa\n";
    // The direction of s / q is a quotient of numbers that are `away` of the trial stress: rounding / away.
    EXPECT_LE(error, 1e-14 / away + 1e-12);
  }
}

TEST(ElastoplasticExtremes, PureVolumetricTension) {
  const SubspaceModuli moduli(sand_elasticity(), {});
  const HardeningCone cone{1.0, 0.2, 2e3};
  ScaledVector<double> strain = ScaledVector<double>::Zero();
  strain.head<3>().setConstant(1e-2);
  const ConeReturn<double> end = step(strain, 0.0, moduli, cone);
  EXPECT_EQ(end.regime, Regime::apex);
  EXPECT_EQ(end.gamma_increment, 0.0);
  EXPECT_NEAR(end.stress(0), 2e3, 1e-9);
  EXPECT_TRUE(consistent_tangent(elastic_stress(moduli, strain), end, moduli).allFinite());
}

TEST(ElastoplasticExtremes, NoStressNoStrainNoCohesion) {
  const SubspaceModuli moduli(sand_elasticity(), {});
  const ConeReturn<double> end =
      step<double>(ScaledVector<double>::Zero(), 0.0, moduli, HardeningCone{1.0, 0.2, 0.0});
  EXPECT_EQ(end.fault, ReturnFault::none);
  EXPECT_EQ(end.regime, Regime::elastic);
  EXPECT_EQ(end.stress.norm(), 0.0);
}

TEST(ElastoplasticExtremes, ConeWithoutStrengthIsRefused) {
  const SubspaceModuli moduli(sand_elasticity(), {});
  ScaledVector<double> strain = ScaledVector<double>::Zero();
  strain(0) = -1e-3;
  EXPECT_EQ(step(strain, 0.0, moduli, FrozenCone{0.0, 0.0, 0.0}).fault, ReturnFault::no_strength);
  EXPECT_EQ(step(strain, 0.0, moduli, FrozenCone{-0.1, 0.0, 0.0}).fault, ReturnFault::no_strength);
}

/// Steep tables with many kinks: the bracket must hold Newton's method, also where it would cycle.
TEST(ElastoplasticExtremes, TablesWithManyKinks) {
  std::vector<PiecewiseLinear::Knot> knots;
  for (int i = 0; i < 60; ++i) {
    knots.push_back({i * 1e-3, 1.0 + (i % 2 == 0 ? 0.3 : 0.0)});
  }
  const HardeningCone cone{PiecewiseLinear(knots), 0.1, 20e3};
  const SubspaceModuli moduli(sand_elasticity(), kKinematic);
  RandomStates random(3);
  int most = 0;
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    const ConeReturn<double> end = step(random.strain(), random.gamma_p(), moduli, cone);
    ASSERT_NE(end.fault, ReturnFault::not_converged) << "state " << i;
    refused += end.fault == ReturnFault::supercritical ? 1 : 0;
    most = std::max(most, end.evaluations);
  }
  std::cout << "[figure] table with 60 kinks: most evaluations " << most << ", refused as too steep "
            << refused << " of 3000\n";
  EXPECT_LE(most, 60);
}

}  // namespace
}  // namespace polargrain::fem::test
