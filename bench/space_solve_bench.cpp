// SPDX-License-Identifier: GPL-2.0-or-later
// One Newton iteration in space over the number of unknowns: assembly, and solution by iterations on levels or directly.
// The tangent is the unsymmetric one of a non-associated law at its first iteration. Usage: space_solve_bench
// ELEMENT ELEMENTS_ALONG [MOST_ITERATIONS]
#include <fmt/format.h>
#include <sys/resource.h>

#include <ctime>
#include <string>

#include "fem/material/cone_matching.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/box.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

constexpr double kConfining = 100e3;

std::shared_ptr<Material<3>> sand() {
  ElastoplasticParameters<3> parameters;
  parameters.elastic.young_modulus = 40e6;
  parameters.elastic.poisson_ratio = 0.3;
  parameters.elastic.cosserat_shear_modulus = 10e6;
  parameters.elastic.internal_length = 5e-3;
  for (int i = 0; i < 3; ++i)
    parameters.elastic.initial_stress(Cosserat<3>::stress_place(i, i)) = -kConfining;
  parameters.cone =
      hardening_cone({PiecewiseLinear::ramp(30.0, 38.0, 0.1), PiecewiseLinear(5.0), PiecewiseLinear(1e3)},
                     ConeMatch::triaxial_compression);
  return std::make_shared<LocalMaterial<ElastoplasticLaw<3>>>(ElastoplasticLaw<3>(parameters));
}

double peak_memory_gb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024e-9;
}

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

class Told : public Observer {
  void solves(const std::string& text) override { fmt::print("  {}\n", text); }
  void iterated(const IterationReport& report) override {
    fmt::print("  iteration {}: force residual {:.2e}, {:.1f} s of processor\n", report.iteration,
               report.force_residual, processor_seconds());
  }
};

}  // namespace

// A cube between rough plates: dead zones that stay elastic, and plastic flow elsewhere.
int main(int argc, char** argv) {
  const std::string element = argc > 1 ? argv[1] : "H20R";
  const int along = argc > 2 ? std::stoi(argv[2]) : 12;
  const int most_iterations = argc > 3 ? std::stoi(argv[3]) : 0;
  Problem<3> problem;
  problem.mesh = box({{0.1, 0.1, 0.1}, {along, along, along}}, element);
  problem.materials["all"] = sand();
  for (const char* const plate : {"bottom", "top"})
    for (const Dof dof : {Dof::u1, Dof::u2, Dof::u3})
      problem.prescribed.push_back(
          {plate,
           dof,
           plate[0] == 't' && dof == Dof::u3 ? TimeTable::ramp(-1e-3) : TimeTable::constant(0.0),
           {}});
  for (const char* const side : {"left", "right", "front", "back"}) {
    BoundaryLoad<3> load;
    load.on = side;
    load.pressure = TimeTable::constant(kConfining);
    problem.boundary_loads.push_back(load);
  }
  fmt::print("{} {}^3, about {} unknowns\n", element, along, 6 * problem.mesh.nodes.size());
  SolverOptions options;
  options.force_tolerance = options.moment_tolerance = 1e-6;
  Told told;
  Solver<3> solver(std::move(problem), options);
  solver.set_observer(&told);
  solver.equilibrate();
  const double start = processor_seconds();
  StepReport sum;
  for (const double time : {0.5, 1.0}) {
    const StepReport report = solver.advance(time, 1.0, most_iterations);
    fmt::print("{}\n", report.converged ? "balanced" : report.message);
    sum.iterations += report.iterations;
    sum.material_seconds += report.material_seconds;
    sum.assembly_seconds += report.assembly_seconds;
    sum.solve_seconds += report.solve_seconds;
    if (most_iterations > 0) break;
  }
  const double iterations = sum.iterations;
  fmt::print(
      "{} iterations, each {:.1f} s of processor (wall: material {:.1f}, assembly {:.1f}, solution {:.1f}), peak {:.1f} GB\n",
      sum.iterations, (processor_seconds() - start) / iterations, sum.material_seconds / iterations,
      sum.assembly_seconds / iterations, sum.solve_seconds / iterations, peak_memory_gb());
}
