// SPDX-License-Identifier: GPL-2.0-or-later
// The synthetic micro scale of docs/theory/plasticity.md, B.9: a point in plane-strain compression whose true
// law hardens, then softens; and what its accuracy table holds schemes to.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <vector>

#include "fem/material/elastoplastic.hpp"

namespace polargrain::testing {

constexpr double kLateral = -100e3;   // Pa
constexpr double kStrain = 0.06;      // vertical, at the end
constexpr double kCohesion = 100.0;   // k of the cone, Pa, numerical
constexpr int kSubSteps = 20;         // of the micro scale within one macro step
constexpr double kStandstill = 1e-4;  // where the fixed point stops: of mu + beta, or of the lateral stress
constexpr double kStartFriction = 0.75;

/// Friction rises along a parabola to its peak and decays to critical state; dilatancy is the friction
/// above critical (a stress-dilatancy rule). Dense knots, so that the pieces do not show.
inline fem::HardeningCone micro_strength() {
  constexpr double kPeak = 1.184;  // a peak of s22/s11 of about 5.65, as in the table of B.9
  constexpr double kCritical = 0.85;
  constexpr double kPeakGamma = 0.0225;
  constexpr double kDecay = 0.045;
  std::vector<fem::PiecewiseLinear::Knot> friction;
  std::vector<fem::PiecewiseLinear::Knot> dilatancy;
  for (int i = 0; i <= 2000; ++i) {
    const double gamma_p = 1e-4 * i;
    const double before = 1.0 - gamma_p / kPeakGamma;
    const double after = (gamma_p - kPeakGamma) / kDecay;
    const double m = gamma_p < kPeakGamma ? kPeak - (kPeak - kStartFriction) * before * before
                                          : kCritical + (kPeak - kCritical) * std::exp(-after * after);
    friction.push_back({gamma_p, m});
    dilatancy.push_back({gamma_p, m - kCritical});
  }
  return {fem::PiecewiseLinear(friction), fem::PiecewiseLinear(dilatancy), kCohesion};
}

inline fem::ElasticParameters<2> elasticity() {
  fem::ElasticParameters<2> elastic;
  elastic.young_modulus = 50e6;
  elastic.poisson_ratio = 0.3;
  elastic.cosserat_shear_modulus = 10e6;
  elastic.internal_length = 1e-3;
  elastic.initial_stress << kLateral, kLateral, kLateral, 0.0, 0.0, 0.0, 0.0;
  return elastic;
}

struct Curve {
  std::vector<double> ratio;  ///< s22 / s11 at the end of each step
  double peak = 0.0;
  double peak_strain = 0.0;
  double calls = 0.0;  ///< of the cell, per step

  void record(double stress_ratio, double strain) {
    ratio.push_back(stress_ratio);
    if (stress_ratio > peak) {
      peak = stress_ratio;
      peak_strain = strain;
    }
  }
};

/// Largest relative error beyond the first 0.4 % of strain, where friction still is a guess (B.9).
inline double error_of(const Curve& curve, const Curve& fine) {
  const std::size_t stride = fine.ratio.size() / curve.ratio.size();
  double worst = 0.0;
  for (std::size_t i = 0; i < curve.ratio.size(); ++i) {
    const double expected = fine.ratio[(i + 1) * stride - 1];
    if (static_cast<double>(i + 1) * kStrain / static_cast<double>(curve.ratio.size()) > 0.004) {
      worst = std::max(worst, std::abs(curve.ratio[i] / expected - 1.0));
    }
  }
  return worst;
}

/// The table of B.9: frozen is of first order with a call a step, the fixed point ten times better with at
/// most six.
/// @param fine the true law in very small steps
/// @param frozen, fixed_point curves of the two updates for a number of steps
inline void expect_accuracy_table(const Curve& fine, const std::function<Curve(int)>& frozen,
                                  const std::function<Curve(int)>& fixed_point, double floor = 0.0) {
  EXPECT_NEAR(fine.peak, 5.649, 0.05);  // the synthetic law is made to peak where the one of the table does
  EXPECT_NEAR(fine.peak_strain, 0.0304, 0.001);
  double previous = 0.0;
  for (const int steps : {60, 120, 240, 480}) {
    const Curve late = frozen(steps);
    const Curve fixed = fixed_point(steps);
    const double late_error = error_of(late, fine);
    const double fixed_error = error_of(fixed, fine);
    std::cout << "[figure] " << steps << " steps: frozen " << 100.0 * late_error << " % (peak " << late.peak
              << "), fixed point " << 100.0 * fixed_error << " % (peak " << fixed.peak << ", " << fixed.calls
              << " calls a step)\n";
    // Read one step late: an error of first order in the step.
    if (previous > 0.0) {
      EXPECT_NEAR(previous / late_error, 2.0, 0.4);
    }
    EXPECT_LE(fixed_error, std::max(late_error / 10.0, floor));
    EXPECT_EQ(late.calls, 1.0);
    EXPECT_LE(fixed.calls, 6.0);
    previous = late_error;
  }
}

}  // namespace polargrain::testing
