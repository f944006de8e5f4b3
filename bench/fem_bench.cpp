// SPDX-License-Identifier: GPL-2.0-or-later
// Cost of one Newton iteration over the number of unknowns: evaluation, assembly, factorisation and solution.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

Problem block(int columns) {
  const TimeTable zero = TimeTable::constant(0.0);
  Problem problem;
  problem.mesh = rectangle({{0.04, 0.08}, {columns, 2 * columns}});
  problem.materials["all"] =
      std::make_shared<LocalMaterial<ElasticLaw>>(ElasticLaw({40e6, 0.3, 10e6, 1e-3, Vector7::Zero()}));
  problem.prescribed = {{"bottom", Dof::u1, zero, {}},
                        {"bottom", Dof::u2, zero, {}},
                        {"top", Dof::u1, zero, {}},
                        {"top", Dof::u2, TimeTable::ramp(-1.0, 1000.0), {}}};
  return problem;
}

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// A linear material takes one iteration a step, so a step is one assembly, factorisation and solution.
void newton_iteration(benchmark::State& state) {
  Solver solver(block(static_cast<int>(state.range(0))), {});
  solver.equilibrate();
  double time = 0.0;
  double material = 0.0;
  double assembly = 0.0;
  double solution = 0.0;
  for (auto _ : state) {
    const StepReport report = solver.advance(time += 1.0);
    if (!report.converged || report.iterations != 1) {
      state.SkipWithError("the step took more than one iteration");
      break;
    }
    material += report.material_seconds;
    assembly += report.assembly_seconds;
    solution += report.solve_seconds;
  }
  const auto average = [](double sum) { return benchmark::Counter(sum, benchmark::Counter::kAvgIterations); };
  state.counters["unknowns"] = static_cast<double>(3 * solver.problem().mesh.nodes.size());
  state.counters["material_s"] = average(material);
  state.counters["assembly_s"] = average(assembly);
  state.counters["solve_s"] = average(solution);
  state.counters["peak_MiB"] = peak_memory_mib();  // of the process so far: sizes ascend
}

BENCHMARK(newton_iteration)->Arg(7)->Arg(15)->Arg(33)->Arg(74)->Arg(105)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
