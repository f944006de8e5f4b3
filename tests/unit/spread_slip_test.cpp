// SPDX-License-Identifier: GPL-2.0-or-later
// Slips that are spread: a softening column against its closed form, tangents against differences, restarts.
#include "fem/spread/spread_slip.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "common/memory_archive.hpp"
#include "fem/material/local_material.hpp"
#include "fem/material/slip_driven_cone.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

constexpr double kDiameter = 0.01;            // m
constexpr double kHeight = 20.0 * kDiameter;  // of the column
constexpr double kWidth = 5.0 * kDiameter;    // of the spread slip
constexpr double kPeak = 100e3, kResidual = 50e3, kSoftening = 1.0;
constexpr double kWeak = 0.98;

ElastoplasticParameters<2> softening(double factor) {
  ElastoplasticParameters<2> parameters;
  parameters.elastic.young_modulus = 40e6;
  parameters.elastic.poisson_ratio = 0.3;
  parameters.cone = {0.0, 0.0, PiecewiseLinear::ramp(factor * kPeak, factor * kResidual, kSoftening)};
  return parameters;
}

/// A periodic column of one element across, sheared; the strength of its middle diameter is 2 % lower.
Problem<2> column(int elements, double overstress) {
  Problem<2> problem;
  const double size = kHeight / elements;
  problem.mesh = rectangle({{size, kHeight}, {1, elements}});
  problem.continuum = Continuum::cauchy;
  problem.mesh.regions.clear();
  for (int e = 0; e < elements; ++e) {
    const bool middle = std::abs((e + 0.5) * size - 0.5 * kHeight) < 0.5 * kDiameter;
    problem.mesh.regions[middle ? "weak" : "rest"].push_back(e);
  }
  problem.materials["weak"] = std::make_shared<SlipDrivenCone<2>>(softening(kWeak));
  problem.materials["rest"] = std::make_shared<SlipDrivenCone<2>>(softening(1.0));
  problem.ties = {{"right", "left"}};
  for (const char* end : {"bottom", "top"})
    problem.prescribed.push_back({end, Dof::u2, TimeTable::constant(0.0), {}});
  problem.prescribed.push_back({"bottom", Dof::u1, TimeTable::constant(0.0), {}});
  problem.prescribed.push_back(
      {"top", Dof::u1, TimeTable::ramp(1.0, 1.0), {}});  // the time is the displacement
  add_spread_slip(problem, {kWidth, overstress});
  return problem;
}

/// The column whose slip has one source in its middle: g = top cosh((H/2 - |z|)/l) / cosh(H/2l).
struct ClosedForm {
  double length = kWidth / (2.0 * std::log(2.0));
  double slip_at_most = 0.0;

  [[nodiscard]] double shape(double z) const {
    return std::cosh((0.5 * kHeight - z) / length) / std::cosh(0.5 * kHeight / length);
  }
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
    const double half = std::acosh(0.5 * std::cosh(0.5 * kHeight / length));
    return 2.0 * (0.5 * kHeight - length * half);
  }
  static ClosedForm at(double displacement) {
    ClosedForm low, high;
    high.slip_at_most = 2.0;
    for (int k = 0; k < 60; ++k) {
      ClosedForm middle;
      middle.slip_at_most = 0.5 * (low.slip_at_most + high.slip_at_most);
      (middle.displacement() < displacement ? low : high) = middle;
    }
    return low;
  }
};

/// Full width at half maximum of the slip along the left side.
double width_of(const Solver<2>& solver) {
  std::map<double, double> slips;
  const Problem<2>& problem = solver.problem();
  for (const int node : problem.fields[0].nodes) {
    const auto& place = problem.mesh.nodes[static_cast<std::size_t>(node)];
    if (place(0) == 0.0) slips[place(1)] = solver.state().displacement(problem.places().entry(0, node));
  }
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

TEST(spread_slip, column_has_the_thickness_and_the_stress_of_the_closed_form_on_each_mesh) {
  for (const double overstress : {0.002, 0.0005}) {
    for (const int elements : {20, 40, 80}) {
      Solver<2> solver(column(elements, overstress), {});
      ASSERT_TRUE(solver.equilibrate().converged);
      int most = 0, cuts = 0, all = 0;
      for (int step = 1; step <= 60; ++step) {
        const double displacement = step * 0.0008;
        const StepReport report = solver.advance(displacement);
        ASSERT_TRUE(report.converged) << step << " " << report.message;
        most = std::max(most, report.iterations), cuts += report.cuts, all += report.iterations;
        const ClosedForm exact = ClosedForm::at(displacement);
        if (step % 20 == 0)
          printf(
              "r %g n %d U %g: stress %.1f exact %.1f width %.3f exact %.3f d, most %d cuts %d mean %.1f\n",
              overstress, elements, displacement, solver.reaction("top")(0) / (kHeight / elements),
              exact.stress(), width_of(solver) / kDiameter, exact.width() / kDiameter, most, cuts,
              all / (double)step);
      }
    }
  }
}

}  // namespace
