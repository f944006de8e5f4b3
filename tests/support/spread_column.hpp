// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>

#include "fem/material/local_material.hpp"
#include "fem/material/slip_driven_cone.hpp"
#include "fem/material/slip_driven_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"
#include "fem/spread/spread_slip.hpp"

/// A column that softens where its slips are spread, and its closed form.
namespace polargrain::testing::spread_column {

using namespace fem;

inline constexpr double kDiameter = 0.01;            // m
inline constexpr double kHeight = 20.0 * kDiameter;  // of the column
inline constexpr double kWidth = 5.0 * kDiameter;    // of the spread slip
inline constexpr double kPeak = 100e3, kResidual = 50e3, kSoftening = 1.0;
inline constexpr double kWeak = 0.98;

inline ElastoplasticParameters<2> softening_of_spread_slip(double factor) {
  ElastoplasticParameters<2> parameters;
  parameters.elastic.young_modulus = 40e6;
  parameters.elastic.poisson_ratio = 0.3;
  parameters.cone = {0.0, 0.0, PiecewiseLinear::ramp(factor * kPeak, factor * kResidual, kSoftening)};
  return parameters;
}

using Law = std::shared_ptr<Material<2>>;
inline Law cone(const ElastoplasticParameters<2>& parameters) {
  return std::make_shared<SlipDrivenCone<2>>(parameters);
}
inline Law cone_of_short_length(const ElastoplasticParameters<2>& parameters) {
  ElastoplasticParameters<2> turning = parameters;
  turning.elastic.cosserat_shear_modulus = 10e6;
  turning.elastic.internal_length = 0.05 * kDiameter;
  return cone(turning);
}
inline Law local(const ElastoplasticParameters<2>& parameters) {
  return std::make_shared<LocalMaterial<ElastoplasticLaw<2>>>(ElastoplasticLaw<2>(parameters));
}
/// The law known by its answers alone.
inline Law answers_of(const ElastoplasticParameters<2>& parameters) {
  return std::make_shared<SlipDrivenMaterial<2>>(local(parameters));
}

/// A periodic column of one element across, sheared; the strength of its middle diameter, or of the half one at `weak`, is 2 % lower.
inline Problem<2> softening_column(int elements, double width = kWidth, double weak = 0.5 * kHeight,
                                   Law (*law)(const ElastoplasticParameters<2>&) = cone,
                                   Continuum continuum = Continuum::cauchy) {
  Problem<2> problem;
  const double size = kHeight / elements;
  problem.mesh = rectangle({{size, kHeight}, {1, elements}});
  problem.continuum = continuum;
  problem.mesh.regions.clear();
  for (int e = 0; e < elements; ++e) {
    const bool middle = std::abs((e + 0.5) * size - weak) < 0.5 * kDiameter;
    problem.mesh.regions[middle ? "weak" : "rest"].push_back(e);
  }
  problem.materials["weak"] = law(softening_of_spread_slip(kWeak));
  problem.materials["rest"] = law(softening_of_spread_slip(1.0));
  problem.ties = {{"right", "left"}};
  for (const char* end : {"bottom", "top"})
    problem.prescribed.push_back({end, Dof::u2, TimeTable::constant(0.0), {}});
  problem.prescribed.push_back({"bottom", Dof::u1, TimeTable::constant(0.0), {}});
  problem.prescribed.push_back(
      {"top", Dof::u1, TimeTable::ramp(1.0, 1.0), {}});  // the time is the displacement
  add_spread_slip(problem, {width});
  return problem;
}

/// l of the width that (1 + x/l) exp(-x/l) has, the slip of one source in an endless column.
inline double length_of(double width) {
  double half = 1.0;
  for (int k = 0; k < 50; ++k) half = std::log(2.0 * (1.0 + half));
  return 0.5 * width / half;
}

/// The column whose slip has one source in its middle: with h half of the height, A g' = delta has g' = cosh((h - |z|)/l) / 2l
/// sinh(h/l), and A g = g' has g = g' + l/2 dg'/dl. Where its ends hold the slip cosh and sinh change places.
struct ClosedForm {
  bool held = false;
  double length = length_of(kWidth);
  double half_height = 0.5 * kHeight;
  double slip_at_most = 0.0;

  [[nodiscard]] double unscaled(double z) const {
    const double x = (half_height - z) / length, end = half_height / length;
    const double even = held ? std::sinh(x) : std::cosh(x), odd = held ? std::cosh(x) : std::sinh(x);
    const double slope = held ? std::tanh(end) : 1.0 / std::tanh(end);
    return even * (1.0 + end * slope) - odd * x;
  }
  [[nodiscard]] double shape(double z) const { return unscaled(z) / unscaled(0.0); }
  /// Mean over the half column, z from its middle.
  template <class Value>
  [[nodiscard]] static double mean(const Value& value) {
    constexpr int kParts = 4000;  // the middle diameter ends on one of their edges
    double sum = 0.0;
    for (int k = 0; k < kParts; ++k) sum += value((k + 0.5) * 0.5 * kHeight / kParts);
    return sum / kParts;
  }
  /// The stress that the mean strength, weighted with the shape, balances.
  [[nodiscard]] double stress() const {
    const auto strength = [&](double z) {
      const double slip = slip_at_most * shape(z);
      return (z < 0.5 * kDiameter ? kWeak : 1.0) *
             (kPeak + (kResidual - kPeak) * std::min(slip / kSoftening, 1.0));
    };
    return mean([&](double z) { return shape(z) * strength(z); }) / mean([&](double z) { return shape(z); }) /
           std::sqrt(3.0);
  }
  [[nodiscard]] double displacement() const {
    const double shear = 40e6 / 2.6;
    return kHeight *
           (stress() / shear + std::sqrt(3.0) * slip_at_most * mean([&](double z) { return shape(z); }));
  }
  [[nodiscard]] double width() const {
    double inside = 0.0, outside = half_height;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (inside + outside);
      (shape(middle) > 0.5 ? inside : outside) = middle;
    }
    return 2.0 * inside;
  }
  static ClosedForm at(double displacement, bool held = false) {
    ClosedForm low, high;
    low.held = high.held = held;
    high.slip_at_most = 2.0;
    for (int k = 0; k < 60; ++k) {
      ClosedForm middle = low;
      middle.slip_at_most = 0.5 * (low.slip_at_most + high.slip_at_most);
      (middle.displacement() < displacement ? low : high) = middle;
    }
    return low;
  }
};

/// Slip along the left side, by height.
inline std::map<double, double> slips_of(const Solver<2>& solver) {
  std::map<double, double> slips;
  const Problem<2>& problem = solver.problem();
  for (const int node : problem.fields[0].nodes) {
    const auto& place = problem.mesh.nodes[static_cast<std::size_t>(node)];
    if (place(0) == 0.0) slips[place(1)] = solver.state().displacement(problem.places().entry(0, node));
  }
  return slips;
}

/// Their full width at half maximum.
inline double width_of(const Solver<2>& solver) {
  const std::map<double, double> slips = slips_of(solver);
  double most = 0.0;
  for (const auto& [z, slip] : slips) most = std::max(most, slip);
  double ends[2] = {0.0, 0.0};
  int found = 0;
  for (auto next = slips.begin(), last = next++; next != slips.end(); last = next++) {
    const double a = last->second - 0.5 * most, b = next->second - 0.5 * most;
    if ((a < 0.0) == (b < 0.0)) continue;
    if (found < 2) ends[found] = last->first + (next->first - last->first) * a / (a - b);
    ++found;
  }
  EXPECT_EQ(found, 2);
  return ends[1] - ends[0];
}

}  // namespace polargrain::testing::spread_column
