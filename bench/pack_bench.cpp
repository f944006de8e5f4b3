// SPDX-License-Identifier: GPL-2.0-or-later
// Processor seconds of making packings.
//
//   build/release/bench/pack_bench > pack.log      from the root of the project; the table goes to standard
//   error
#include <fmt/format.h>

#include <cstdio>
#include <ctime>
#include <fstream>
#include <sstream>

#include "common/error.hpp"
#include "dem/engine/engine.hpp"
#include "dem/pack/prepare.hpp"

namespace {

polargrain::PackingSpecification specification(int dimension, int grains, double friction) {
  polargrain::PackingSpecification made;
  made.dimension = dimension;
  made.spheres = dimension == 3;
  made.script_file = dimension == 3 ? "liggghts_inputs/cells/spheres_hooke_radii.in"
                                    : "liggghts_inputs/cells/hooke_radii.in";
  std::ostringstream text;
  text << std::ifstream(made.script_file).rdbuf();
  made.script = text.str();
  made.grains = grains;
  made.sizes.radii = {3e-3, 7e-3};
  made.density = 2650.0;
  made.thickness = dimension == 3 ? 0.0 : 0.1;
  made.pressure = 1e5;
  made.friction = friction;
  return made;
}

void measure(const char* what, const polargrain::PackingSpecification& asked) {
  const std::clock_t start = std::clock();
  std::string reached;
  double steps = 0.0;
  try {
    const polargrain::PreparedPacking made = polargrain::dem::prepare_packing(asked, {});
    reached = fmt::format("{:10.4f} {:10.3f}", made.reached.void_ratio, made.reached.coordination_number);
    steps = made.reached.dem_steps;
  } catch (const polargrain::RunError& error) {
    reached = error.what();
  }
  fmt::print(stderr, "{:44} {:6} {:9.1f} {:>10.0f} {}\n", what, asked.grains,
             static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, steps, reached);
}

}  // namespace

int main() {
  polargrain::dem::start_engine_process();
  fmt::print(stderr, "{:44} {:>6} {:>9} {:>10} {:>10} {:>10}\n", "packing under 100 kPa", "grains", "seconds",
             "DEM steps", "void ratio", "contacts");
  for (const int grains : {400, 2000}) {
    measure("discs, no friction", specification(2, grains, 0.0));
    measure("discs, friction 0.5", specification(2, grains, 0.5));
  }
  polargrain::PackingSpecification asked = specification(2, 400, 0.5);
  asked.void_ratio = 0.22;
  measure("discs, void ratio 0.22 (steps of the last try)", asked);
  for (const int grains : {400, 2000})
    measure("spheres in space, friction 0.5", specification(3, grains, 0.5));
  return 0;
}
