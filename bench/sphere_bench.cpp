// SPDX-License-Identifier: GPL-2.0-or-later
// The cost of a cell of spheres: the packing of cases/spheres (1,000 spheres) along triaxial compression at constant
// volume, in increments of 1e-3, with several contact models, in processor time; and its condensed tangent.
//
//   build/release/bench/sphere_bench        2> figures, from the root of the project; a minute
#include <fmt/format.h>
#include <time.h>

#include <fstream>
#include <sstream>
#include <string>

#include "common/packing.hpp"
#include "common/processor.hpp"
#include "dem/cell/cell_service.hpp"

namespace polargrain {
namespace {

constexpr int kIncrements = 5;

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string file_text(const std::string& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Five increments from the packing; the last stress over its pressure goes beside the cost.
struct Walk {
  double seconds = 0.0;
  std::int64_t steps = 0;
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
};
Walk walk(CellService& cell) {
  Walk done;
  CellRequest request;
  request.increment.displacement_gradient.diagonal() << 5e-4, 5e-4, -1e-3;
  const double start = processor_seconds();
  for (int k = 0; k < kIncrements; ++k) {
    CellReply reply = cell.evaluate(request);
    request.state = reply.state;
    done.steps += reply.diagnostics.dem_steps;
    done.stress = reply.response.stress;
  }
  done.seconds = processor_seconds() - start;
  return done;
}

/// The spheres of cases/spheres under their script, with other contact models.
CellDefinition spheres(const std::string& style) {
  CellDefinition definition;
  definition.script_file = "liggghts_inputs/cells/spheres_hooke_radii.in";
  definition.script = file_text(definition.script_file);
  const std::string stock = "pair_style      gran model hooke/radii tangential history";
  definition.script.replace(definition.script.find(stock), stock.size(), style);
  definition.packing = read_packing("cases/spheres/packing1000.csv");
  return definition;
}

void bench(const std::string& name, const std::string& style, double inertial_number, double reference) {
  CellDefinition definition = spheres(style);
  definition.control.inertial_number = inertial_number;
  definition.control.tangent = CellTangent::none;
  const Walk bare = walk(*dem::make_cell_service(definition));
  definition.control.tangent = CellTangent::condensed;
  const Walk whole = walk(*dem::make_cell_service(definition));
  const double grains = static_cast<double>(definition.packing.grains.size());
  const double deviator = bare.stress(0, 0) - bare.stress(2, 2);
  fmt::print(stderr, "{:<34} {:>8.0e} {:>7.0f} {:>9.0f} {:>9.1f} {:>9.1f} {:>9}\n", name, inertial_number,
             static_cast<double>(bare.steps) / kIncrements,
             1e9 * bare.seconds / (static_cast<double>(bare.steps) * grains),
             1e3 * bare.seconds / kIncrements, 1e3 * (whole.seconds - bare.seconds) / kIncrements,
             reference > 0.0 ? fmt::format("{:.1f}", 100.0 * (deviator / reference - 1.0)) : "");
}

/// q of the slow walk, Pa.
double slow_deviator(const std::string& style) {
  CellDefinition definition = spheres(style);
  definition.control.inertial_number = 1e-4;
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = 5e-4;
  definition.control.tangent = CellTangent::none;
  const Walk done = walk(*dem::make_cell_service(definition));
  return done.stress(0, 0) - done.stress(2, 2);
}

int main_of_bench() {
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 1);
  setenv("OMPI_MCA_btl", "self", 1);
  dem::start_engine_process();
  const std::string rolling =
      "fix fr all property/global coefficientRollingFriction peratomtypepair 1 0.1\n"
      "fix kr all property/global rollingStiffnessRatio peratomtypepair 1 1.0\n";
  const std::string head = "pair_style gran model hooke/radii tangential ";
  const std::string plain = head + "history";
  const double reference = slow_deviator(plain);
  fmt::print(stderr, "{}\n1,000 spheres, increments of 1e-3, processor time\n\n", processor_model());
  fmt::print(stderr, "{:<34} {:>8} {:>7} {:>9} {:>9} {:>9} {:>9}\n", "contacts", "inertial", "steps",
             "ns/sphere", "ms", "+tangent", "off (%)");
  for (const double inertial_number : {2e-4, 6e-4, 1e-3, 2e-3})
    bench("hooke/radii, history", plain, inertial_number, reference);
  bench("the same with epsd2",
        "fix fr all property/global coefficientRollingFriction peratomtypepair 1 0.1\n" + head +
            "history rolling_friction epsd2",
        6e-4, 0.0);
  bench("hooke/radii, li_chu", head + "li_chu", 6e-4, 0.0);
  bench("the same with rolling li_chu", rolling + head + "li_chu rolling_friction li_chu", 6e-4, 0.0);
  bench("and torsion", rolling + head + "li_chu rolling_friction li_chu torsionTorque on", 6e-4, 0.0);
  return 0;
}

}  // namespace
}  // namespace polargrain

int main() {
  return polargrain::main_of_bench();
}
