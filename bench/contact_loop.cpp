// SPDX-License-Identifier: GPL-2.0-or-later
// Nanoseconds a particle and time step of the contact models, side by side: the stock program `liggghts`, the
// same stock models in polargrain-liggghts, and this project's models; both with the loop over pairs and with the kernels of
// `suffix fast`. Best of several rounds of processor time, the variants taking turns, because the machine is not
// alone.
//
//   build/release/bench/contact_loop      from the root of the project; about a minute
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

struct Variant {
  std::string program;
  std::string models;
  double best = 1e300;  ///< ns a particle and step
};

constexpr int kRounds = 3;
constexpr int kSteps = 1000;
constexpr int kDiscs = 1600;  // bench/contact_loop.in

/// Processor time of the program's run, s; negative when it failed. Other programs on the machine count little.
double processor_seconds(const Variant& variant, int steps) {
  const auto spent = [] {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
  };
  const double before = spent();
  const std::string command =
      fmt::format("{} -in bench/contact_loop.in -log none -var steps {} -var models \"{}\" > /dev/null 2>&1",
                  variant.program, steps, variant.models);
  return std::system(command.c_str()) == 0 ? spent() - before : -1.0;
}

double nanoseconds(const Variant& variant) {
  const double start_up = processor_seconds(variant, 0);
  const double whole = processor_seconds(variant, kSteps);
  return start_up < 0.0 || whole < 0.0 ? -1.0 : 1e9 * (whole - start_up) / kDiscs / kSteps;
}

}  // namespace

int main() {
  struct Row {
    std::string what;
    std::string models;
    bool stock;  // known to the stock program
  };
  const std::vector<Row> rows{
      {"hooke/stiffness, history", "hooke/stiffness tangential history absolute_damping on", true},
      {"hooke/stiffness, history, epsd2",
       "hooke/stiffness tangential history rolling_friction epsd2 absolute_damping on", true},
      {"hertz, history", "hertz tangential history", true},
      {"hertz, history, epsd2", "hertz tangential history rolling_friction epsd2", true},
      {"hooke/radii, history", "hooke/radii tangential history", false},
      {"hooke/radii, history, epsd2", "hooke/radii tangential history rolling_friction epsd2", false},
      {"hooke/radii, history, rolling li_chu", "hooke/radii tangential history rolling_friction li_chu",
       false},
      {"hooke/radii, li_chu, rolling li_chu", "hooke/radii tangential li_chu rolling_friction li_chu", false},
      {"the same with rolling force",
       "hooke/radii tangential li_chu rolling_friction li_chu rollingFrictionForce on", false},
      {"the same, symmetric",
       "hooke/radii tangential li_chu rolling_friction li_chu rollingFrictionForce on symmetricCoupling on",
       false},
      {"hertz, li_chu, rolling li_chu", "hertz tangential li_chu rolling_friction li_chu", false},
      {"hooke/radii, li_chu", "hooke/radii tangential li_chu", false}};
  const bool have_stock = std::system("command -v liggghts > /dev/null") == 0;
  const std::string own = POLARGRAIN_LIGGGHTS;
  std::vector<std::array<Variant, 3>> table;
  for (const Row& row : rows)
    table.push_back({Variant{row.stock && have_stock ? "liggghts" : "", row.models}, Variant{own, row.models},
                     Variant{own + " -suffix fast", row.models}});
  for (int round = 0; round < kRounds; ++round)
    for (std::array<Variant, 3>& variants : table)
      for (Variant& variant : variants) {
        if (variant.program.empty()) continue;
        const double time = nanoseconds(variant);
        if (time < 0.0) {
          fmt::print(stderr,
                     "contact_loop: '{}' did not run with {}; start it from the root of the project\n",
                     variant.models, variant.program);
          return 1;
        }
        variant.best = std::min(variant.best, time);
      }
  fmt::print("models,`liggghts`,`polargrain-liggghts`,`-suffix fast`,ratio of the two\n");
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto& [stock, plain, fast] = table[k];
    fmt::print("\"{}\",{},{:.0f},{:.0f},{:.2f}\n", rows[k].what,
               stock.program.empty() ? "" : fmt::format("{:.0f}", stock.best), plain.best, fast.best,
               fast.best / plain.best);
  }
  return 0;
}
