// SPDX-License-Identifier: GPL-2.0-or-later
// Evaluations of the elastoplastic law (stress and consistent tangent) a second on one core, by regime.
#include <benchmark/benchmark.h>

#include "fem/material/cone_matching.hpp"
#include "fem/material/elastoplastic.hpp"

namespace {

using namespace polargrain;
using namespace polargrain::fem;

/// Dense sand under 100 kPa whose friction, dilatancy and cohesion soften.
ElastoplasticLaw<2> sand(const InvariantWeights& weights) {
  ElastoplasticParameters<2> parameters;
  parameters.elastic.young_modulus = 40e6;
  parameters.elastic.poisson_ratio = 0.3;
  parameters.elastic.cosserat_shear_modulus = 10e6;
  parameters.elastic.internal_length = 1e-3;
  parameters.elastic.initial_stress << -100e3, -100e3, -100e3, 0.0, 0.0, 0.0, 0.0;
  parameters.weights = weights;
  parameters.cone = hardening_cone_from_plane_strain({PiecewiseLinear::ramp(40.0, 32.0, 0.1),
                                                      PiecewiseLinear::ramp(10.0, 0.0, 0.1),
                                                      PiecewiseLinear::ramp(1e3, 0.5e3, 0.1)});
  return ElastoplasticLaw<2>(parameters);
}

void run(benchmark::State& bench, const InvariantWeights& weights, const Increment<2>& increment,
         Regime expected) {
  const ElastoplasticLaw<2> law = sand(weights);
  const ElastoplasticState<2> start = law.initial_state();
  ElastoplasticState<2> trial;
  for (auto _ : bench) {
    Response<2> response = law.integrate(start, increment, trial);
    benchmark::DoNotOptimize(response);
  }
  if (trial.regime != expected) {
    bench.SkipWithError("the increment did not end in the regime this benchmark is named after");
  }
  bench.counters["evaluations"] =
      benchmark::Counter(static_cast<double>(bench.iterations()), benchmark::Counter::kIsRate);
}

Increment<2> compression(double size) {
  Increment<2> increment;
  increment.displacement_gradient << 0.4 * size, 0.3 * size, 0.0, -size;
  increment.micro_rotation = 0.1 * size;
  increment.curvature << 50.0 * size, -20.0 * size;
  return increment;
}

Increment<2> tension(double size) {
  Increment<2> increment = compression(0.1 * size);
  increment.displacement_gradient.diagonal().array() += size;
  return increment;
}

constexpr InvariantWeights kStandard{};
constexpr InvariantWeights kKinematic{0.75, -0.25, 0.125};

}  // namespace

BENCHMARK_CAPTURE(run, elastic, kStandard, compression(1e-5), Regime::elastic);
BENCHMARK_CAPTURE(run, smooth_standard_weights, kStandard, compression(1e-2), Regime::smooth);
BENCHMARK_CAPTURE(run, smooth_kinematic_weights, kKinematic, compression(1e-2), Regime::smooth);
BENCHMARK_CAPTURE(run, apex, kStandard, tension(1e-2), Regime::apex);
