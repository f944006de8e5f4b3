// SPDX-License-Identifier: GPL-2.0-or-later
// Processor seconds of making packings.
//
//   build/release/bench/pack_bench > pack.log      from the root of the project; the table goes to standard
//   error
//   build/release/bench/pack_bench spheres 1000 0.5 [automatic|engine [seed]] > pack.log      one packing; `discs` or
//   `spheres`, grains, friction, loop
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string_view>

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
  if (dimension == 3) made.damping = polargrain::kDampingInSpace;
  return made;
}

void measure(const char* what, const polargrain::PackingSpecification& asked) {
  const std::clock_t start = std::clock();
  std::string reached;
  double steps = 0.0;
  try {
    const auto tell = [](const polargrain::PackingReached& now) {
      fmt::print(
          "[pack] {:9.0f} steps: void ratio {:.5f}, pressure {:.5g}, anisotropy {:.2e}, shear {:.2e}, contacts "
          "{:.4f}, unbalanced {:.2e}\n",
          now.dem_steps, now.void_ratio, now.pressure, now.anisotropy, now.shear, now.coordination_number,
          now.unbalanced_force_ratio);
    };
    const polargrain::PreparedPacking made = polargrain::dem::prepare_packing(asked, tell);
    reached = fmt::format("{:10.4f} {:10.3f}", made.reached.void_ratio, made.reached.coordination_number);
    steps = made.reached.dem_steps;
  } catch (const polargrain::RunError& error) {
    reached = error.what();
  }
  fmt::print(stderr, "{:44} {:6} {:9.1f} {:>10.0f} {}\n", what, asked.grains,
             static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, steps, reached);
}

}  // namespace

int main(int count, char** words) {
  polargrain::dem::start_engine_process();
  fmt::print(stderr, "{:44} {:>6} {:>9} {:>10} {:>10} {:>10}\n", "packing under 100 kPa", "grains", "seconds",
             "DEM steps", "void ratio", "contacts");
  if (count > 3) {
    const bool space = std::string_view(words[1]) == "spheres";
    polargrain::PackingSpecification asked =
        specification(space ? 3 : 2, std::atoi(words[2]), std::atof(words[3]));
    const bool engine = count > 4 && std::string_view(words[4]) == "engine";
    if (engine) asked.loop = polargrain::CellLoop::engine;
    if (count > 5) asked.seed = static_cast<std::uint64_t>(std::atoi(words[5]));
    measure(fmt::format("{}, friction {}{}", words[1], words[3], engine ? ", LIGGGHTS's loop" : "").c_str(),
            asked);
    return 0;
  }
  for (const int grains : {400, 2000}) {
    measure("discs, no friction", specification(2, grains, 0.0));
    measure("discs, friction 0.5", specification(2, grains, 0.5));
  }
  polargrain::PackingSpecification asked = specification(2, 400, 0.5);
  asked.void_ratio = 0.22;
  measure("discs, void ratio 0.22 (steps of the last try)", asked);
  for (const int grains : {400, 2000})
    for (const double friction : {0.0, 0.5})
      measure(fmt::format("spheres in space, friction {}", friction).c_str(),
              specification(3, grains, friction));
  return 0;
}
