// SPDX-License-Identifier: GPL-2.0-or-later
// Nanoseconds a particle and time step of the contact models, as ratios in one run: stock models put together at run
// time, the same compiled as one with the lean loop, and this project's models. Best of several rounds, the variants
// taking turns, because the machine is not alone.
//
//   build/release/bench/contact_loop      from the root of the project; about a minute
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace {

struct Variant {
  std::string what;
  std::string program;
  std::string models;
  double best = 1e300;  ///< ns a particle and step
};

constexpr int kRounds = 3;
constexpr int kSteps = 1000;

double nanoseconds(const Variant& variant) {
  const std::string command =
      fmt::format("{} -in bench/contact_loop.in -log none -var steps {} -var models \"{}\" 2>&1",
                  variant.program, kSteps, variant.models);
  FILE* const pipe = popen(command.c_str(), "r");
  std::array<char, 1024> line{};
  double seconds = 0.0;
  int particles = 0;
  while (std::fgets(line.data(), line.size(), pipe))
    std::sscanf(line.data(), "Loop time of %lf on 1 procs for %*d steps with %d atoms", &seconds, &particles);
  return pclose(pipe) == 0 && particles > 0 ? 1e9 * seconds / particles / kSteps : -1.0;
}

}  // namespace

int main() {
  const std::string library = POLARGRAIN_LIGGGHTS;
  const std::string compiled = POLARGRAIN_COMPILED_COPY;
  std::vector<Variant> variants{
      {"hooke/stiffness, history, put together at run time", library,
       "hooke/stiffness tangential history absolute_damping on"},
      {"hooke/stiffness, history, compiled, lean loop", compiled,
       "hooke/stiffness tangential history absolute_damping on"},
      {"hooke/stiffness, history, epsd2, at run time", library,
       "hooke/stiffness tangential history rolling_friction epsd2 absolute_damping on"},
      {"hooke/radii, history", compiled, "hooke/radii tangential history"},
      {"hooke/radii, history, epsd2", compiled, "hooke/radii tangential history rolling_friction epsd2"},
      {"hooke/radii, li_chu, rolling li_chu", compiled,
       "hooke/radii tangential li_chu rolling_friction li_chu"},
      {"the same with rolling force", compiled,
       "hooke/radii tangential li_chu rolling_friction li_chu rollingFrictionForce on"},
      {"the same, symmetric", compiled,
       "hooke/radii tangential li_chu rolling_friction li_chu rollingFrictionForce on symmetricCoupling on"},
      {"hooke/radii, li_chu, no rolling (put together at run time)", compiled,
       "hooke/radii tangential li_chu"}};
  for (int round = 0; round < kRounds; ++round)
    for (Variant& variant : variants) {
      const double time = nanoseconds(variant);
      if (time < 0.0) {
        fmt::print(stderr, "contact_loop: '{}' did not run; start it from the root of the project\n",
                   variant.what);
        return 1;
      }
      variant.best = std::min(variant.best, time);
    }
  fmt::print("{:60} {:>8} {:>8}\n", "discs, 3 contacts each", "ns", "ratio");
  for (const Variant& variant : variants)
    fmt::print("{:60} {:8.1f} {:8.2f}\n", variant.what, variant.best, variant.best / variants.front().best);
  return 0;
}
