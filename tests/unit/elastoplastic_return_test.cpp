// SPDX-License-Identifier: GPL-2.0-or-later
// Return mapping and tangent on random states, variant by variant (docs/theory/plasticity.md, B.7).
#include <gtest/gtest.h>

#include <algorithm>
#include <iomanip>
#include <iostream>

#include "tests/unit/elastoplastic_variants.hpp"

namespace polargrain::fem::test {
namespace {

constexpr int kStates = 1200;

class ReturnMapping : public ::testing::TestWithParam<Variant> {
 protected:
  ReturnMapping() : moduli(sand_elasticity(), GetParam().weights) {}
  SubspaceModuli moduli;
  RandomStates random{20190122};
};

double largest_stiffness(const SubspaceModuli& moduli) {
  return elastic_stiffness(moduli).cwiseAbs().maxCoeff();
}

TEST_P(ReturnMapping, TangentEqualsComplexStep) {
  const HardeningCone& cone = GetParam().cone;
  std::array<double, 3> worst{};
  std::array<int, 3> count{};
  int most_evaluations = 0;
  for (int i = 0; i < kStates; ++i) {
    const ScaledVector<double> strain = random.strain();
    const double gamma_p = random.gamma_p();
    const ConeReturn<double> end = step(strain, gamma_p, moduli, cone);
    ASSERT_EQ(end.fault, ReturnFault::none) << "state " << i;
    const ScaledMatrix<double> tangent = consistent_tangent(elastic_stress(moduli, strain), end, moduli);
    const double error =
        (tangent - complex_step_tangent(strain, gamma_p, moduli, cone)).cwiseAbs().maxCoeff() /
        largest_stiffness(moduli);
    const auto regime = static_cast<std::size_t>(end.regime);
    worst[regime] = std::max(worst[regime], error);
    ++count[regime];
    most_evaluations = std::max(most_evaluations, end.evaluations);
  }
  std::cout << "[figure] " << GetParam().name << ": smooth " << count[1] << " error " << worst[1] << ", apex "
            << count[2] << " error " << worst[2] << ", elastic " << count[0] << " error " << worst[0]
            << ", most evaluations " << most_evaluations << '\n';
  EXPECT_GT(count[1], kStates / 5);
  // Both derivatives are exact but for rounding, which the cone's side magnifies by q_trial / q at most.
  EXPECT_LE(*std::ranges::max_element(worst), 1e-10);
  // Newton's method with the exact slope; a wrong slope still converges, but not this fast.
  EXPECT_LE(most_evaluations, 6);
}

TEST_P(ReturnMapping, TangentEqualsCentralDifferences) {
  const HardeningCone& cone = GetParam().cone;
  double worst = 0.0;
  int compared = 0;
  for (int i = 0; i < kStates; ++i) {
    const ScaledVector<double> strain = random.strain();
    const double gamma_p = random.gamma_p();
    const ConeReturn<double> end = step(strain, gamma_p, moduli, cone);
    const double h = 1e-6 * strain.norm();
    ScaledMatrix<double> difference;
    bool one_branch = true;  // across a change of regime or of the hardening piece there is no derivative
    const auto same_branch = [&](const ConeReturn<double>& other) {
      return other.regime == end.regime && other.cone.friction_slope == end.cone.friction_slope &&
             other.cone.cohesion_slope == end.cone.cohesion_slope &&
             other.cone.dilatancy_slope == end.cone.dilatancy_slope;
    };
    for (int column = 0; column < 7; ++column) {
      const ScaledVector<double> shift = h * ScaledVector<double>::Unit(column);
      const ConeReturn<double> above = step<double>(strain + shift, gamma_p, moduli, cone);
      const ConeReturn<double> below = step<double>(strain - shift, gamma_p, moduli, cone);
      one_branch = one_branch && same_branch(above) && same_branch(below);
      difference.col(column) = (above.stress - below.stress) / (2.0 * h);
    }
    if (!one_branch) {
      continue;
    }
    ++compared;
    const ScaledMatrix<double> tangent = consistent_tangent(elastic_stress(moduli, strain), end, moduli);
    worst = std::max(worst, (tangent - difference).cwiseAbs().maxCoeff() / largest_stiffness(moduli));
  }
  std::cout << "[figure] " << GetParam().name << ": central differences error " << worst << " of " << compared
            << " states\n";
  EXPECT_GT(compared, kStates * 9 / 10);
  EXPECT_LE(worst, 1e-6);  // h^2 truncation plus rounding over h: 1e-12 + 1e-16 / 1e-6, with room
}

TEST_P(ReturnMapping, EndsOnOrInsideTheCone) {
  const HardeningCone& cone_at = GetParam().cone;
  double worst_residual = 0.0;
  for (int i = 0; i < kStates; ++i) {
    const ScaledVector<double> strain = random.strain();
    const double gamma_p = random.gamma_p();
    const ScaledVector<double> trial = elastic_stress(moduli, strain);
    const ConeReturn<double> end = step(strain, gamma_p, moduli, cone_at);
    ASSERT_GE(end.gamma_increment, 0.0);
    const Cone<double> cone = cone_at(gamma_p + end.gamma_increment);
    const Split<double> split(end.stress);
    const Split<double> trial_split(trial);
    const double q = deviatoric_stress(split, moduli);
    const double scale =
        deviatoric_stress(trial_split, moduli) + cone.cohesion + cone.friction * std::abs(trial_split.mean);
    const double yield = cone.yield_function(q, split.mean) / scale;
    if (end.regime == Regime::elastic) {
      EXPECT_LE(yield, 1e-12);
    } else {
      worst_residual = std::max(worst_residual, std::abs(yield));
    }
  }
  std::cout << "[figure] " << GetParam().name << ": yield residual " << worst_residual << '\n';
  EXPECT_LE(worst_residual, 1e-12);  // the scalar solve stops at 1e-13 of the trial stress
}

/// The plastic strain follows the flow rule, and sqrt((2/3) e P^+ e) of its deviatoric part is d lambda.
TEST_P(ReturnMapping, PlasticShearEqualsMultiplier) {
  double worst_gamma = 0.0;
  double worst_volume = 0.0;
  for (int i = 0; i < kStates; ++i) {
    const ScaledVector<double> strain = random.strain();
    const ConeReturn<double> end = step(strain, random.gamma_p(), moduli, GetParam().cone);
    if (end.regime != Regime::smooth) {
      continue;
    }
    const ScaledVector<double> lost = elastic_stress(moduli, strain) - end.stress;  // D times plastic strain
    const Split<double> split(lost);
    double squared = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (moduli.weight[k] > 0.0) {
        squared += (split.part[k] / moduli.stiffness[k]).squaredNorm() / moduli.weight[k];
      } else {
        EXPECT_LE(split.part[k].norm(), 1e-12 * elastic_stress(moduli, strain).norm());
      }
    }
    const double gamma = std::sqrt(2.0 / 3.0 * squared);
    const double volume = split.mean / moduli.bulk;
    worst_gamma = std::max(worst_gamma, std::abs(gamma - end.gamma_increment) / strain.norm());
    worst_volume =
        std::max(worst_volume, std::abs(volume - end.cone.dilatancy * end.gamma_increment) / strain.norm());
  }
  std::cout << "[figure] " << GetParam().name << ": |gamma_p - lambda| " << worst_gamma
            << ", |volume - M_psi lambda| " << worst_volume << " of the strain\n";
  EXPECT_LE(worst_gamma, 1e-13);  // rounding of a stress difference
  EXPECT_LE(worst_volume, 1e-13);
}

/// On a line of trial states from the side of the cone to its apex the stress does not jump at the switch.
TEST_P(ReturnMapping, ApexJoinsTheSide) {
  const HardeningCone& cone = GetParam().cone;
  int crossings = 0;
  double worst = 0.0;
  for (int i = 0; i < kStates; ++i) {
    ScaledVector<double> side = random.strain();
    ScaledVector<double> tip = random.strain();
    const double gamma_p = random.gamma_p();
    if (step(side, gamma_p, moduli, cone).regime != Regime::smooth ||
        step(tip, gamma_p, moduli, cone).regime != Regime::apex) {
      continue;
    }
    const double trial_stress = elastic_stress(moduli, tip).norm() + elastic_stress(moduli, side).norm();
    bool straight = true;
    for (int halving = 0; halving < 45; ++halving) {
      const ScaledVector<double> middle = 0.5 * (side + tip);
      const Regime regime = step(middle, gamma_p, moduli, cone).regime;
      straight = straight && regime != Regime::elastic;
      (regime == Regime::apex ? tip : side) = middle;
    }
    if (!straight) {
      continue;
    }
    ++crossings;
    const double jump =
        (step(side, gamma_p, moduli, cone).stress - step(tip, gamma_p, moduli, cone).stress).norm();
    worst = std::max(worst, jump / trial_stress);
  }
  std::cout << "[figure] " << GetParam().name << ": stress jump at the apex switch " << worst
            << " of the trial stress, " << crossings << " crossings\n";
  if (cone.friction.at(0.0).value > 0.0) {
    EXPECT_GT(crossings, 20);
  } else {
    EXPECT_EQ(crossings, 0);  // without friction there is no apex
  }
  EXPECT_LE(worst, 1e-11);  // 45 halvings leave 3e-14 of the line between the two states
}

INSTANTIATE_TEST_SUITE_P(Variants, ReturnMapping, ::testing::ValuesIn(variants()),
                         [](const auto& info) { return info.param.name; });

/// Without hardening and with the default weights the multiplier is known in closed form.
TEST(ReturnMappingClosedForm, LinearCohesionSoftening) {
  const SubspaceModuli moduli(sand_elasticity(), {});
  const double slope = -2e6;
  const HardeningCone cone{0.8, 0.3, PiecewiseLinear({{0.0, 100e3}, {0.04, 100e3 + 0.04 * slope}})};
  ScaledVector<double> strain;
  strain << 2e-3, -9e-3, 0.0, 4e-3, 1e-3, 2e-3, -1e-3;
  const Split<double> trial(elastic_stress(moduli, strain));
  const double yield = deviatoric_stress(trial, moduli) + 0.8 * trial.mean - 100e3;
  const double expected = yield / (3.0 * moduli.shear() + moduli.bulk * 0.8 * 0.3 + slope);
  const ConeReturn<double> end = step(strain, 0.0, moduli, cone);
  ASSERT_EQ(end.regime, Regime::smooth);
  EXPECT_NEAR(end.gamma_increment, expected, 1e-14 * expected / 1e-3);
  EXPECT_LE(end.evaluations, 3);
}

/// FrozenCone and a HardeningCone of constants are the same cone: the same bits must come out.
TEST(ReturnMappingClosedForm, FrozenConeIsAConstantCone) {
  const SubspaceModuli moduli(sand_elasticity(), kStatic);
  RandomStates random(7);
  for (int i = 0; i < 200; ++i) {
    const ScaledVector<double> strain = random.strain();
    const ConeReturn<double> frozen = step(strain, 0.0, moduli, FrozenCone{0.9, 0.25, 1e3});
    const ConeReturn<double> constant = step(strain, 0.0, moduli, HardeningCone{0.9, 0.25, 1e3});
    ASSERT_EQ(frozen.stress, constant.stress);
    ASSERT_EQ(frozen.gamma_increment, constant.gamma_increment);
  }
}

}  // namespace
}  // namespace polargrain::fem::test
