// SPDX-License-Identifier: GPL-2.0-or-later
// Steps of the law against the rate equations they discretise (docs/theory/plasticity.md, B.2), which are
// integrated here by a Runge-Kutta method with D and P written out in components: no projector, no return.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <vector>

#include "fem/material/cone_matching.hpp"
#include "fem/material/elastoplastic.hpp"

namespace polargrain::fem::test {
namespace {

constexpr double kLength = 1.0;  // scaled and unscaled components coincide

ElastoplasticParameters<2> sand(const InvariantWeights& weights) {
  ElastoplasticParameters<2> parameters;
  parameters.elastic.young_modulus = 50e6;
  parameters.elastic.poisson_ratio = 0.3;
  parameters.elastic.cosserat_shear_modulus = 10e6;
  parameters.elastic.internal_length = kLength;
  parameters.elastic.initial_stress << -100e3, -100e3, -100e3, 0.0, 0.0, 0.0, 0.0;
  parameters.weights = weights;
  parameters.cone = hardening_cone_from_plane_strain({PiecewiseLinear::ramp(35.0, 28.0, 0.1),
                                                      PiecewiseLinear::ramp(12.0, 2.0, 0.1),
                                                      PiecewiseLinear::ramp(10e3, 2e3, 0.1)});
  return parameters;
}

/// Strain of the path at time t in [0, 1]: compression that turns into shear, skew shear and bending.
Vector7 path(double t) {
  Vector7 strain;
  strain << 0.015 * t, -0.02 * t, 0.0, 0.012 * t * t, 0.028 * t * t, 0.005 * t * t, -0.003 * t * t * t;
  return strain;
}

Increment<2> increment_between(double from, double to) {
  const Vector7 strain = path(to) - path(from);
  Increment<2> increment;
  increment.displacement_gradient << strain(k11), strain(k21), strain(k12), strain(k22);
  increment.curvature << strain(kCurvature1), strain(kCurvature2);
  return increment;
}

struct Point {
  Vector7 stress;
  double gamma_p = 0.0;
};

/// The rate equations with every matrix written out.
class Rates {
 public:
  explicit Rates(const ElastoplasticParameters<2>& parameters) : cone_(parameters.cone) {
    const double e = parameters.elastic.young_modulus;
    const double nu = parameters.elastic.poisson_ratio;
    const double g = e / (2.0 * (1.0 + nu));
    const double lame = 2.0 * g * nu / (1.0 - 2.0 * nu);
    const double gc = parameters.elastic.cosserat_shear_modulus;
    const auto& [a1, a2, a3] = parameters.weights;
    stiffness_.setZero();
    stiffness_.topLeftCorner<3, 3>().setConstant(lame);
    stiffness_.diagonal() << lame + 2.0 * g, lame + 2.0 * g, lame + 2.0 * g, g + gc, g + gc, 2.0 * g, 2.0 * g;
    stiffness_(3, 4) = stiffness_(4, 3) = g - gc;
    weights_.setZero();
    weights_.topLeftCorner<3, 3>().setConstant(-1.0 / 3.0);
    weights_.diagonal() << 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 * a1, 2.0 * a1, 2.0 * a3, 2.0 * a3;
    weights_(3, 4) = weights_(4, 3) = 2.0 * a2;
  }

  [[nodiscard]] double yield(const Point& point) const {
    return cone_(point.gamma_p).yield_function(deviator(point.stress), mean(point.stress));
  }
  [[nodiscard]] Vector7 elastic(const Vector7& strain) const { return stiffness_ * strain; }

  /// d (stress, gamma_p) / dt while loading.
  [[nodiscard]] Point plastic_rate(const Point& point, const Vector7& strain_rate) const {
    const Cone<double> cone = cone_(point.gamma_p);
    Vector7 one = Vector7::Zero();
    one.head<3>().setOnes();
    const Vector7 deviatoric = 1.5 / deviator(point.stress) * (weights_ * point.stress);
    const Vector7 normal = deviatoric + cone.friction / 3.0 * one;
    const Vector7 flow = deviatoric + cone.dilatancy / 3.0 * one;
    const double hardening = cone.cohesion_slope - cone.friction_slope * mean(point.stress);
    const double multiplier =
        normal.dot(stiffness_ * strain_rate) / (normal.dot(stiffness_ * flow) + hardening);
    return {stiffness_ * (strain_rate - multiplier * flow), multiplier};
  }

 private:
  static double mean(const Vector7& stress) { return stress.head<3>().sum() / 3.0; }
  [[nodiscard]] double deviator(const Vector7& stress) const {
    return std::sqrt(1.5 * stress.dot(weights_ * stress));
  }

  HardeningCone cone_;
  Matrix7 stiffness_;
  Matrix7 weights_;
};

/// Time of first yield on the path.
double yield_time(const Rates& rates, const Vector7& initial) {
  double elastic = 0.0;
  double plastic = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (elastic + plastic);
    (rates.yield({initial + rates.elastic(path(middle)), 0.0}) < 0.0 ? elastic : plastic) = middle;
  }
  return elastic;
}

Point runge_kutta(const Rates& rates, Point point, double from, int steps) {
  const double h = (1.0 - from) / steps;
  const auto rate = [&](const Point& at, double t) {
    constexpr double kShift = 1e-2;
    const Vector7 wide = (path(t + kShift) - path(t - kShift)) / (2.0 * kShift);
    const Vector7 narrow = (path(t + 0.5 * kShift) - path(t - 0.5 * kShift)) / kShift;
    return rates.plastic_rate(at, (4.0 * narrow - wide) / 3.0);  // exact for a cubic
  };
  const auto moved = [](const Point& at, const Point& slope, double by) {
    return Point{at.stress + by * slope.stress, at.gamma_p + by * slope.gamma_p};
  };
  for (int i = 0; i < steps; ++i) {
    const double t = from + i * h;
    const Point s1 = rate(point, t);
    const Point s2 = rate(moved(point, s1, 0.5 * h), t + 0.5 * h);
    const Point s3 = rate(moved(point, s2, 0.5 * h), t + 0.5 * h);
    const Point s4 = rate(moved(point, s3, h), t + h);
    point.stress += h / 6.0 * (s1.stress + 2.0 * s2.stress + 2.0 * s3.stress + s4.stress);
    point.gamma_p += h / 6.0 * (s1.gamma_p + 2.0 * s2.gamma_p + 2.0 * s3.gamma_p + s4.gamma_p);
  }
  return point;
}

class RateEquations : public ::testing::TestWithParam<InvariantWeights> {};

TEST_P(RateEquations, StepsConvergeToThemWithFirstOrder) {
  const ElastoplasticParameters<2> parameters = sand(GetParam());
  const Rates rates(parameters);
  const Vector7& initial = parameters.elastic.initial_stress;
  const double start = yield_time(rates, initial);
  const Point at_yield{initial + rates.elastic(path(start)), 0.0};
  const Point exact = runge_kutta(rates, at_yield, start, 4000);
  const Point coarse = runge_kutta(rates, at_yield, start, 2000);
  ASSERT_GT(exact.gamma_p, 0.01);
  ASSERT_LT(exact.gamma_p, 0.1);  // no kink on the way
  EXPECT_LE((exact.stress - coarse.stress).norm(), 1e-10 * exact.stress.norm());
  EXPECT_LE(std::abs(rates.yield(exact)), 1e-9 * exact.stress.norm());

  const ElastoplasticLaw<2> law(parameters);
  std::vector<Vector7> ends;
  std::vector<double> errors;
  for (const int steps : {50, 100, 200, 400, 800}) {
    ElastoplasticState<2> state;
    ElastoplasticState<2> trial;
    ASSERT_EQ(law.integrate(law.initial_state(), increment_between(0.0, start), state).quality,
              Quality::good);
    for (int i = 0; i < steps; ++i) {
      const double h = (1.0 - start) / steps;
      const Increment<2> increment = increment_between(start + i * h, start + (i + 1) * h);
      ASSERT_EQ(law.integrate(state, increment, trial).quality, Quality::good);
      ASSERT_EQ(trial.regime, Regime::smooth);
      state = trial;
    }
    ends.push_back(state.scaled_stress);
    errors.push_back((state.scaled_stress - exact.stress).norm() / exact.stress.norm());
    std::cout << "[figure] a1 = " << GetParam().a1 << ", " << steps << " steps: stress error "
              << errors.back() << ", gamma_p error " << std::abs(state.gamma_p / exact.gamma_p - 1.0) << '\n';
  }
  for (std::size_t i = 1; i < errors.size(); ++i) {
    EXPECT_NEAR(errors[i - 1] / errors[i], 2.0, 0.1);  // backward Euler
  }
  // With the first-order error extrapolated away both must be one solution.
  const double extrapolated = (2.0 * ends[4] - ends[3] - exact.stress).norm() / exact.stress.norm();
  std::cout << "[figure] a1 = " << GetParam().a1 << ", extrapolated: stress error " << extrapolated << '\n';
  EXPECT_LE(extrapolated, 0.01 * errors.back());
}

INSTANTIATE_TEST_SUITE_P(Weights, RateEquations,
                         ::testing::Values(InvariantWeights{}, InvariantWeights{0.375, 0.125, 0.25},
                                           InvariantWeights{0.75, -0.25, 0.125}),
                         [](const auto& info) { return "weights" + std::to_string(info.index); });

}  // namespace
}  // namespace polargrain::fem::test
