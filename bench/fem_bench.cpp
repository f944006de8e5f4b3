// SPDX-License-Identifier: GPL-2.0-or-later
// Cost of one Newton iteration over the number of unknowns: evaluation, assembly, factorisation and solution.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <ctime>

#include "fem/material/cone_matching.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

constexpr double kConfining = 100e3;

std::shared_ptr<Material<2>> sand() {
  ElastoplasticParameters<2> parameters;
  parameters.elastic = {40e6, 0.3, 10e6, 1e-3, Vector7::Zero()};
  for (const int i : {k11, k22, k33}) parameters.elastic.initial_stress(i) = -kConfining;
  parameters.cone = hardening_cone_from_plane_strain({PiecewiseLinear::ramp(30.0, 38.0, 0.1), 5.0, 1e3});
  return std::make_shared<LocalMaterial<ElastoplasticLaw<2>>>(ElastoplasticLaw<2>(parameters));
}

/// Compression between rough plates: dead corners that stay elastic, and plastic flow elsewhere.
Problem<2> block(int columns) {
  const TimeTable zero = TimeTable::constant(0.0);
  Problem<2> problem;
  problem.mesh = rectangle({{0.04, 0.08}, {columns, 2 * columns}});
  problem.materials["all"] = sand();
  problem.prescribed = {{"bottom", Dof::u1, zero, {}},
                        {"bottom", Dof::u2, zero, {}},
                        {"top", Dof::u1, zero, {}},
                        {"top", Dof::u2, TimeTable::ramp(-0.08, 1000.0), {}}};
  for (const char* side : {"left", "right"}) {
    problem.boundary_loads.push_back({.on = side, .pressure = TimeTable::constant(kConfining)});
  }
  return problem;
}

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// A step is several iterations, each one evaluation, assembly, factorisation and solution. The counters are
/// processor seconds an iteration, shared out in the proportion of the wall times of the parts, so that other
/// work on the machine does not count.
void newton_step(benchmark::State& state) {
  Solver<2> solver(block(static_cast<int>(state.range(0))), {});
  solver.equilibrate();
  double time = 10.0;  // 1 % of strain: most of the block flows
  for (int step = 1; step <= 4; ++step) solver.advance(time * step / 4);
  double material = 0.0;
  double assembly = 0.0;
  double solution = 0.0;
  double steps = 0.0;
  int iterations = 0;
  const std::clock_t start = std::clock();
  for (auto _ : state) {
    const StepReport report = solver.advance(time += 1.0);
    if (!report.converged) {
      state.SkipWithError(report.message.c_str());
      break;
    }
    steps += 1.0;
    iterations += report.iterations;
    material += report.material_seconds;
    assembly += report.assembly_seconds;
    solution += report.solve_seconds;
  }
  const double processor = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const double share = processor / (material + assembly + solution) / iterations;
  state.counters["unknowns"] = static_cast<double>(3 * solver.problem().mesh.nodes.size());
  state.counters["iterations"] = iterations / steps;
  state.counters["material_s"] = material * share;
  state.counters["assembly_s"] = assembly * share;
  state.counters["solve_s"] = solution * share;
  state.counters["peak_MiB"] = peak_memory_mib();  // of the process so far: sizes ascend
}

BENCHMARK(newton_step)->Arg(7)->Arg(15)->Arg(33)->Arg(74)->Arg(105)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
