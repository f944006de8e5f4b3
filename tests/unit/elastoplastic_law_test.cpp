// SPDX-License-Identifier: GPL-2.0-or-later
// The law as the finite elements see it: unscaled components, states, faults.
#include <gtest/gtest.h>

#include <iostream>
#include <limits>

#include "common/error.hpp"
#include "fem/material/cone_matching.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/local_material.hpp"

namespace polargrain::fem {
namespace {

static_assert(LocalLaw<ElastoplasticLaw<2>> && LawWithFields<ElastoplasticLaw<2>>);

/// Dense sand of docs/verification.md, E.5, at 100 kPa.
ElastoplasticParameters<2> dense_sand() {
  ElastoplasticParameters<2> sand;
  sand.elastic.young_modulus = 40e6;
  sand.elastic.poisson_ratio = 0.3;
  sand.elastic.cosserat_shear_modulus = 10e6;
  sand.elastic.internal_length = 2e-3;
  sand.elastic.initial_stress << -100e3, -100e3, -100e3, 0.0, 0.0, 0.0, 0.0;
  sand.cone = hardening_cone_from_plane_strain({PiecewiseLinear::ramp(40.0, 32.0, 0.1),
                                                PiecewiseLinear::ramp(10.0, 0.0, 0.1),
                                                PiecewiseLinear::ramp(1e3, 0.5e3, 0.1)});
  return sand;
}

Increment<2> shear_and_bend(double size) {
  Increment<2> increment;
  increment.displacement_gradient << 0.2 * size, size, 0.3 * size, -0.5 * size;
  increment.micro_rotation = 0.1 * size;
  increment.curvature << 40.0 * size, -70.0 * size;
  return increment;
}

bool one_fault_with(const std::vector<std::string>& found, const std::string& text) {
  return found.size() == 1 && found.front().find(text) != std::string::npos;
}

TEST(ElastoplasticLaw, StartsFromTheInitialStress) {
  ElastoplasticParameters<2> sand = dense_sand();
  sand.elastic.initial_stress << -100e3, -90e3, -95e3, 5e3, 4e3, 3.0, -2.0;
  const ElastoplasticLaw<2> law(sand);
  ElastoplasticState<2> trial;
  const Response<2> response = law.integrate(law.initial_state(), Increment<2>{}, trial);
  EXPECT_EQ(response.quality, Quality::good);
  EXPECT_LE((response.stress - sand.elastic.initial_stress).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_EQ(trial.gamma_p, 0.0);
  EXPECT_EQ(trial.regime, Regime::elastic);
}

TEST(ElastoplasticLaw, ElasticStepsEqualTheElasticLaw) {
  const ElastoplasticParameters<2> sand = dense_sand();
  const ElastoplasticLaw<2> law(sand);
  const ElasticLaw<2> elastic(sand.elastic);
  ElastoplasticState<2> trial;
  ElasticLaw<2>::State elastic_trial;
  const Increment<2> increment = shear_and_bend(1e-4);
  const Response<2> response = law.integrate(law.initial_state(), increment, trial);
  const Response<2> expected = elastic.integrate(elastic.initial_state(), increment, elastic_trial);
  ASSERT_EQ(trial.regime, Regime::elastic);
  EXPECT_LE((response.stress - expected.stress).cwiseAbs().maxCoeff(), 1e-15 * 40e6);
  EXPECT_LE((response.tangent - expected.tangent).cwiseAbs().maxCoeff(), 1e-15 * 40e6);
}

/// The tangent is with respect to the unscaled strain; central differences over whole increments.
TEST(ElastoplasticLaw, UnscaledTangentEqualsCentralDifferences) {
  const ElastoplasticLaw<2> law(dense_sand());
  ElastoplasticState<2> trial;
  const Increment<2> increment = shear_and_bend(5e-3);
  const Response<2> response = law.integrate(law.initial_state(), increment, trial);
  ASSERT_EQ(trial.regime, Regime::smooth);
  ElastoplasticState<2> unused;
  double worst = 0.0;
  for (const int column : {0, 1, 3, 4, 5, 6}) {  // eps_33 cannot be varied in plane strain
    const double lc = 2e-3;
    const double h = column < 5 ? 1e-8 : 1e-8 / lc;
    const auto shifted = [&](double step) {
      Increment<2> other = increment;
      switch (column) {
        case k11:
          other.displacement_gradient(0, 0) += step;
          break;
        case k22:
          other.displacement_gradient(1, 1) += step;
          break;
        case k12:
          other.displacement_gradient(1, 0) += step;
          break;
        case k21:
          other.displacement_gradient(0, 1) += step;
          break;
        default:
          other.curvature(column - kCurvature1) += step;
      }
      return law.integrate(law.initial_state(), other, unused).stress;
    };
    Vector7 error = (shifted(h) - shifted(-h)) / (2.0 * h) - response.tangent.col(column);
    error.tail<2>() /= lc;
    if (column >= 5) {
      error /= lc;
    }
    worst = std::max(worst, error.cwiseAbs().maxCoeff() / 40e6);
  }
  std::cout << "[figure] unscaled tangent against central differences " << worst << '\n';
  EXPECT_LE(worst, 1e-6);
}

TEST(ElastoplasticLaw, RepeatingAStepGivesTheSameBits) {
  const ElastoplasticLaw<2> law(dense_sand());
  ElastoplasticState<2> first;
  ElastoplasticState<2> second;
  const Response<2> a = law.integrate(law.initial_state(), shear_and_bend(1e-2), first);
  const Response<2> b = law.integrate(law.initial_state(), shear_and_bend(1e-2), second);
  EXPECT_EQ(a.stress, b.stress);
  EXPECT_EQ(a.tangent, b.tangent);
  EXPECT_EQ(first.gamma_p, second.gamma_p);
}

TEST(ElastoplasticLaw, NoIncrementAfterAPlasticStepChangesNothing) {
  const ElastoplasticLaw<2> law(dense_sand());
  ElastoplasticState<2> start;
  ElastoplasticState<2> trial;
  ASSERT_EQ(law.integrate(law.initial_state(), shear_and_bend(5e-3), start).quality, Quality::good);
  ASSERT_EQ(start.regime, Regime::smooth);
  ASSERT_EQ(law.integrate(start, Increment<2>{}, trial).quality, Quality::good);
  EXPECT_LE((trial.scaled_stress - start.scaled_stress).norm(), 1e-12 * start.scaled_stress.norm());
  EXPECT_LE(trial.gamma_p - start.gamma_p, 1e-14);
}

TEST(ElastoplasticLaw, WithoutLengthThereIsNoCoupleStress) {
  ElastoplasticParameters<2> sand = dense_sand();
  sand.elastic.internal_length = 0.0;
  const ElastoplasticLaw<2> law(sand);
  ElastoplasticState<2> trial;
  const Response<2> response = law.integrate(law.initial_state(), shear_and_bend(5e-3), trial);
  ASSERT_EQ(response.quality, Quality::good);
  ASSERT_EQ(trial.regime, Regime::smooth);
  EXPECT_EQ(response.stress.tail<2>().norm(), 0.0);
  EXPECT_EQ(response.tangent.bottomRows<2>().norm(), 0.0);
  EXPECT_EQ(response.tangent.rightCols<2>().norm(), 0.0);
  EXPECT_TRUE(response.tangent.allFinite());
}

/// The law depends on lc kappa and m / lc only: from a tiny to a huge length the answers are one answer.
TEST(ElastoplasticLaw, AnyInternalLengthGivesTheSameScaledAnswer) {
  ElastoplasticParameters<2> sand = dense_sand();
  sand.elastic.internal_length = 1.0;
  const ElastoplasticLaw<2> reference_law(sand);
  Increment<2> increment = shear_and_bend(5e-3);
  increment.curvature *= 0.05;  // bends as much as it shears when lc = 1
  ElastoplasticState<2> reference_state;
  const Response<2> reference =
      reference_law.integrate(reference_law.initial_state(), increment, reference_state);
  ASSERT_EQ(reference_state.regime, Regime::smooth);
  ASSERT_GT(std::abs(reference.stress(kCurvature1)), 1e3);
  for (const double length : {1e-9, 1e-3, 1e6}) {
    sand.elastic.internal_length = length;
    const ElastoplasticLaw<2> law(sand);
    Increment<2> scaled = increment;
    scaled.curvature /= length;
    ElastoplasticState<2> trial;
    const Response<2> response = law.integrate(law.initial_state(), scaled, trial);
    EXPECT_LE((trial.scaled_stress - reference_state.scaled_stress).norm(), 1e-14 * 40e6);
    EXPECT_LE((response.stress.tail<2>() / length - reference.stress.tail<2>()).norm(), 1e-14 * 40e6);
    EXPECT_LE((response.tangent.bottomRightCorner<2, 2>() / (length * length) -
               reference.tangent.bottomRightCorner<2, 2>())
                  .norm(),
              1e-12 * 40e6);
  }
}

TEST(ElastoplasticLaw, WithoutCosseratModulusTheShearStressStaysSymmetric) {
  ElastoplasticParameters<2> sand = dense_sand();
  sand.elastic.cosserat_shear_modulus = 0.0;
  for (const InvariantWeights weights : {InvariantWeights{}, InvariantWeights{0.75, -0.25, 0.125}}) {
    sand.weights = weights;
    const ElastoplasticLaw<2> law(sand);
    ElastoplasticState<2> trial;
    const Response<2> response = law.integrate(law.initial_state(), shear_and_bend(5e-3), trial);
    ASSERT_EQ(response.quality, Quality::good);
    ASSERT_EQ(trial.regime, Regime::smooth);
    EXPECT_EQ(response.stress(k12), response.stress(k21));
  }
}

TEST(ElastoplasticLaw, ApexTangentCarriesTheElasticShare) {
  ElastoplasticParameters<2> sand = dense_sand();
  sand.cone = {1.0, 0.2, 1e3};  // perfect: the apex itself is rigid, its own tangent zero
  sand.apex_stiffness_share = 1e-3;
  const ElastoplasticLaw<2> law(sand);
  Increment<2> tension;
  tension.displacement_gradient << 0.02, 0.0, 0.0, 0.02;
  ElastoplasticState<2> trial;
  const Response<2> response = law.integrate(law.initial_state(), tension, trial);
  ASSERT_EQ(trial.regime, Regime::apex);
  EXPECT_NEAR(response.stress(k11), 1e3, 1e-9);  // k / M_phi
  // With the default weights the skew shear stays elastic; the rest of the apex has no stiffness of its own.
  Matrix7 expected = 1e-3 * elastic_stiffness(sand.elastic);
  expected.block<2, 2>(k12, k12) += 10e6 * Eigen::Matrix2d{{1.0, -1.0}, {-1.0, 1.0}};
  EXPECT_LE((response.tangent - expected).norm(), 1e-15 * 40e6);
}

/// Dry sand without any confinement: pulled apart it carries nothing, pressed together it carries at once.
TEST(ElastoplasticLaw, WithoutConfinementAndCohesion) {
  ElastoplasticParameters<2> sand = dense_sand();
  sand.elastic.initial_stress.setZero();
  sand.cone.cohesion = 0.0;
  const ElastoplasticLaw<2> law(sand);
  Increment<2> increment;
  increment.displacement_gradient << 1e-3, 2e-3, 0.0, 1e-3;
  increment.micro_rotation = -1e-3;
  ElastoplasticState<2> apart;
  const Response<2> pulled = law.integrate(law.initial_state(), increment, apart);
  ASSERT_EQ(pulled.quality, Quality::good);
  EXPECT_EQ(apart.regime, Regime::apex);
  EXPECT_EQ(pulled.stress.head<3>().norm(), 0.0);
  EXPECT_TRUE(pulled.tangent.allFinite());
  EXPECT_GT(pulled.tangent.diagonal().minCoeff(), 0.0);  // the elastic share

  increment.displacement_gradient << 0.0, 2e-4, 0.0, -2e-3;
  ElastoplasticState<2> together;
  const Response<2> pressed = law.integrate(apart, increment, together);
  ASSERT_EQ(pressed.quality, Quality::good);
  EXPECT_LT(pressed.stress(k22), -1e3);
  EXPECT_TRUE(pressed.tangent.allFinite());
}

TEST(ElastoplasticLaw, BrokenIncrementFailsAndLeavesTheStartState) {
  const ElastoplasticLaw<2> law(dense_sand());
  Increment<2> broken;
  broken.displacement_gradient(0, 0) = std::numeric_limits<double>::quiet_NaN();
  ElastoplasticState<2> trial;
  const Response<2> response = law.integrate(law.initial_state(), broken, trial);
  EXPECT_EQ(response.quality, Quality::failed);
  EXPECT_FALSE(response.message.empty());
  EXPECT_GT(response.step_factor, 0.0);
  EXPECT_LT(response.step_factor, 1.0);
  EXPECT_EQ(trial.scaled_stress, law.initial_state().scaled_stress);
}

/// Allowed at the initial pressure, supercritical at a hundred times that pressure: must say so.
TEST(ElastoplasticLaw, SofteningTooSteepUnderPressureFails) {
  ElastoplasticParameters<2> sand = dense_sand();
  sand.cone = {PiecewiseLinear::ramp(1.0, 0.5, 0.003), 0.0, 1e3};
  const SubspaceModuli moduli(sand.elastic, sand.weights);
  ASSERT_GT(softening_reserve(sand.cone, moduli, -100e3), 0.0);
  ASSERT_LT(softening_reserve(sand.cone, moduli, -10e6), 0.0);
  const ElastoplasticLaw<2> law(sand);
  ElastoplasticState<2> pressed = law.initial_state();
  pressed.scaled_stress.head<3>().setConstant(-10e6);
  Increment<2> shear;  // s12 = s21 = G gamma, just beyond the yield stress of about 10 MPa / sqrt 3
  shear.displacement_gradient(0, 1) = 0.376;
  shear.micro_rotation = -0.188;
  ElastoplasticState<2> trial;
  const Response<2> response = law.integrate(pressed, shear, trial);
  EXPECT_EQ(response.quality, Quality::failed);
  EXPECT_NE(response.message.find("not unique"), std::string::npos) << response.message;
  EXPECT_EQ(trial.gamma_p, pressed.gamma_p);
}

TEST(ElastoplasticLaw, FrozenConeOfOnePointGivesTheSameAsAConstantLaw) {
  ElastoplasticParameters<2> sand = dense_sand();
  sand.cone = {0.9, 0.25, 500.0};
  const ElastoplasticLaw<2> law(sand);
  const ElastoplasticFrame<2> frame{SubspaceModuli(sand.elastic, sand.weights), sand.elastic.internal_length,
                                    sand.apex_stiffness_share};
  ElastoplasticState<2> a;
  ElastoplasticState<2> b;
  const Response<2> from_law = law.integrate(law.initial_state(), shear_and_bend(5e-3), a);
  const Response<2> from_cone = integrate_elastoplastic(frame, FrozenCone{0.9, 0.25, 500.0},
                                                        law.initial_state(), shear_and_bend(5e-3), b);
  EXPECT_EQ(from_law.stress, from_cone.stress);
  EXPECT_EQ(from_law.tangent, from_cone.tangent);
  EXPECT_EQ(a.gamma_p, b.gamma_p);
}

TEST(ElastoplasticParameters, SoundOnesHaveNoFaults) {
  EXPECT_TRUE(faults(dense_sand()).empty());
}

TEST(ElastoplasticParameters, EachFaultIsNamed) {
  const auto with = [](auto change) {
    ElastoplasticParameters<2> sand = dense_sand();
    change(sand);
    return faults(sand);
  };
  EXPECT_TRUE(one_fault_with(with([](auto& s) { s.weights.a1 = 0.5; }), "1/2"));
  EXPECT_TRUE(one_fault_with(with([](auto& s) { s.weights = {0.1, 0.4, 0.5}; }), "convex"));
  EXPECT_TRUE(one_fault_with(with([](auto& s) { s.weights.a3 = -1.0; }), "a3"));
  EXPECT_TRUE(one_fault_with(with([](auto& s) { s.apex_stiffness_share = 1.0; }), "[0, 1)"));
  EXPECT_TRUE(one_fault_with(with([](auto& s) { s.cone = {0.0, 0.0, 0.0}; }), "no strength"));
  EXPECT_TRUE(one_fault_with(with([](auto& s) { s.cone = {-0.1, -0.2, 1e3}; }), "negative"));
  EXPECT_TRUE(one_fault_with(with([](auto& s) { s.cone = {0.3, 0.4, 1e3}; }), "create energy"));
  EXPECT_TRUE(one_fault_with(with([](auto& s) {
                               s.cone.friction = PiecewiseLinear::ramp(1.0, 0.5, 1e-6);
                               s.cone.dilatancy = 0.0;
                             }),
                             "3G + K M_phi M_psi"));
  EXPECT_TRUE(one_fault_with(with([](auto& s) { s.elastic.initial_stress(k22) = -900e3; }), "outside"));
  EXPECT_TRUE(one_fault_with(with([](auto& s) {
                               s.elastic.internal_length = 0.0;
                               s.elastic.initial_stress(kCurvature1) = 1.0;
                             }),
                             "lc = 0"));
  EXPECT_TRUE(one_fault_with(with([](auto& s) {
                               s.elastic.cosserat_shear_modulus = 0.0;
                               s.elastic.initial_stress(k12) = 1e3;
                             }),
                             "Gc = 0"));
  ElastoplasticParameters<2> broken = dense_sand();
  broken.weights.a3 = -1.0;
  EXPECT_THROW(ElastoplasticLaw<2>{broken}, RunError);
}

}  // namespace
}  // namespace polargrain::fem
