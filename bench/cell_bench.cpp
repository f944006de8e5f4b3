// SPDX-License-Identifier: GPL-2.0-or-later
// What a cell costs: one evaluation of strain 1e-3 with the unbalanced force it reaches, over the tolerance
// asked for; time a particle and DEM step; bytes of a state. Error against the finest run of the same table,
// on the isochoric path.
//
//   build/release/bench/cell_bench        from the root of the project; about a minute
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <algorithm>
#include <utility>
#include <vector>

#include "dem/cell/cell_service.hpp"
#include "tests/support/cell_fixture.hpp"

namespace polargrain {
namespace {

constexpr int kIncrements = 10;

struct Run {
  std::vector<Vector7> stresses;
  double seconds = 0.0;
  std::int64_t dem_steps = 0;
  double unbalanced = 0.0;
  std::size_t state_bytes = 0;
};

Run isochoric(const CellControl& control) {
  CellDefinition definition = test::demo_cell();
  definition.control = control;
  const auto cell = dem::make_cell_service(definition);
  Run run;
  StatePointer state;
  for (int k = 0; k < kIncrements; ++k) {
    CellRequest request;
    request.state = state;
    request.increment.displacement_gradient << 1e-3, 0.0, 0.0, -1e-3;
    const auto start = std::chrono::steady_clock::now();
    const CellReply reply = cell->evaluate(request);
    run.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    run.stresses.push_back(reply.response.stress);
    run.dem_steps += reply.diagnostics.dem_steps;
    run.unbalanced = std::max(run.unbalanced, reply.diagnostics.unbalanced_force_ratio);
    run.state_bytes = reply.state->bytes().size();
    state = reply.state;
  }
  return run;
}

double error(const Run& run, const Run& reference) {
  double worst = 0.0;
  for (int k = 0; k < kIncrements; ++k)
    for (const int component : {k11, k22})
      worst = std::max(worst, std::abs(run.stresses[k](component) / reference.stresses[k](component) - 1.0));
  return worst;
}

CellControl control(double inertial_number, double tolerance, CellTangent tangent) {
  CellControl made;
  made.inertial_number = inertial_number;
  made.unbalanced_force_ratio = made.unbalanced_moment_ratio = tolerance;
  made.tangent = tangent;
  return made;
}

}  // namespace
}  // namespace polargrain

int main() {
  using namespace polargrain;
  dem::start_engine_process();
  std::string table =
      fmt::format("{:>10} {:>10} {:>10} {:>12} {:>12} {:>10} {:>14} {:>10}\n", "tolerance", "inertial",
                  "tangent", "unbalanced", "steps/eval", "ms/eval", "ns/grain-step", "error %");
  const Run reference = isochoric(control(1e-5, 5e-4, CellTangent::none));
  for (const double inertial : {8e-4, 4e-4, 2e-4, 1e-4, 5e-5})
    for (const double tolerance : {1e-2, 5e-3, 1e-3}) {
      const Run run = isochoric(control(inertial, tolerance, CellTangent::none));
      table += fmt::format("{:>10.0e} {:>10.0e} {:>10} {:>12.1e} {:>12} {:>10.1f} {:>14.0f} {:>10.2f}\n",
                           tolerance, inertial, "none", run.unbalanced, run.dem_steps / kIncrements,
                           1e3 * run.seconds / kIncrements, 1e9 * run.seconds / (400.0 * run.dem_steps),
                           100.0 * error(run, reference));
    }
  for (const auto& [name, tangent] :
       {std::pair{"voigt", CellTangent::voigt}, std::pair{"condensed", CellTangent::condensed}}) {
    const CellControl standard;
    const Run run = isochoric(control(standard.inertial_number, standard.unbalanced_force_ratio, tangent));
    table += fmt::format("{:>10.0e} {:>10.0e} {:>10} {:>12.1e} {:>12} {:>10.1f} {:>14.0f} {:>10.2f}\n",
                         standard.unbalanced_force_ratio, standard.inertial_number, name, run.unbalanced,
                         run.dem_steps / kIncrements, 1e3 * run.seconds / kIncrements,
                         1e9 * run.seconds / (400.0 * run.dem_steps), 100.0 * error(run, reference));
  }
  table +=
      fmt::format("state: {} bytes, {:.0f} a grain\n", reference.state_bytes, reference.state_bytes / 400.0);
  // The engine talks on standard output; the table goes where it can be told apart.
  std::fputs(table.c_str(), stderr);
}
