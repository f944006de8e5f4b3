// SPDX-License-Identifier: GPL-2.0-or-later
// What a cell costs, in processor time: accuracy over cost on the isochoric path of tests/data/paths400.csv,
// a particle and DEM step with and without control of the rotations. The tangent: tangent_bench.
//
//   build/release/bench/cell_bench        from the root of the project; about two minutes
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <utility>
#include <vector>

#include "dem/cell/cell_service.hpp"
#include "tests/support/cell_fixture.hpp"

namespace polargrain {
namespace {

constexpr int kIncrements = 10;

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Run {
  std::vector<Vector7> stresses;
  double seconds = 0.0;
  std::int64_t dem_steps = 0;
  double unbalanced = 0.0;
};

Run isochoric(CellDefinition definition, const CellControl& control, const Increment& more = {}) {
  definition.control = control;
  const auto cell = dem::make_cell_service(definition);
  Run run;
  CellRequest request;
  request.increment = more;
  request.increment.displacement_gradient << 1e-3, 0.0, 0.0, -1e-3;
  for (int k = 0; k < kIncrements; ++k) {
    const double start = processor_seconds();
    const CellReply reply = cell->evaluate(request);
    run.seconds += processor_seconds() - start;
    run.stresses.push_back(reply.response.stress);
    run.dem_steps += reply.diagnostics.dem_steps;
    run.unbalanced = std::max(run.unbalanced, reply.diagnostics.unbalanced_force_ratio);
    request.state = reply.state;
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

CellControl control(double inertial_number, double tolerance) {
  CellControl made;
  made.inertial_number = inertial_number;
  made.unbalanced_force_ratio = made.unbalanced_moment_ratio = tolerance;
  made.tangent = CellTangent::none;
  return made;
}

std::string sweep() {
  std::string table = fmt::format("{:>10} {:>10} {:>12} {:>12} {:>10} {:>10}\n", "tolerance", "inertial",
                                  "unbalanced", "steps/eval", "ms/eval", "error %");
  const Run reference = isochoric(test::demo_cell(), control(1e-5, 1e-4));
  for (const double inertial : {8e-4, 2e-4, 5e-5})
    for (const double tolerance : {1e-2, 5e-3, 1e-3, 3e-4, 1e-4}) {
      const Run run = isochoric(test::demo_cell(), control(inertial, tolerance));
      table += fmt::format("{:>10.0e} {:>10.0e} {:>12.1e} {:>12} {:>10.1f} {:>10.2f}\n", tolerance, inertial,
                           run.unbalanced, run.dem_steps / kIncrements, 1e3 * run.seconds / kIncrements,
                           100.0 * error(run, reference));
    }
  return table;
}

std::string modes() {
  std::string table = fmt::format("{:<48} {:>14}\n", "contacts and rotations", "ns/grain-step");
  const auto row = [&table](const std::string& name, const Run& run) {
    table += fmt::format("{:<48} {:>14.0f}\n", name, 1e9 * run.seconds / (400.0 * run.dem_steps));
  };
  CellControl standard = control(2e-4, 5e-3);
  row("history, free", isochoric(test::demo_cell(), standard));
  row("history, rolling li_chu, free", isochoric(test::rolling_cell(1.0, 0.4), standard));
  standard.rotations = CellRotations::controlled;
  row("history, controlled", isochoric(test::demo_cell(), standard));
  Increment bend;
  bend.micro_rotation = 1e-4;
  bend.curvature << 0.02, -0.01;
  row("history, rolling li_chu, controlled, curvature",
      isochoric(test::rolling_cell(1.0, 0.4), standard, bend));
  return table;
}

}  // namespace
}  // namespace polargrain

int main() {
  using namespace polargrain;
  dem::start_engine_process();
  const std::string tables = sweep() + "\n" + modes();
  // The engine talks on standard output; the tables go where they can be told apart.
  std::fputs(tables.c_str(), stderr);
}
