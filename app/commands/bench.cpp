// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/bench/bench.hpp"

#include <memory>

#include "app/commands/command.hpp"

namespace polargrain::app {
namespace {

/// The default of bench when no case is named: the demo with its packings; quickly, on a coarser mesh.
void take_demo(BenchOptions& options) {
  options.cases.emplace_back(brought_along("cases/biaxial/case.yaml"));
  if (options.quick) options.settings.insert(options.settings.begin(), "mesh.rectangle.elements=[2, 4]");
  if (!options.pack.empty()) return;
  options.pack = brought_along("cases/packings/dense400.yaml");
  options.grains =
      options.quick ? std::vector<int>{100, 400, 800} : std::vector<int>{100, 200, 400, 800, 1600};
}

/// Packings that bench makes, and what it looks for in all runs.
void add_comparisons(CLI::App& command, BenchOptions& to) {
  BenchOptions* const options = &to;
  CLI::Option* packing =
      command
          .add_option("--pack", options->pack,
                      "Specification of packings to make and try, in all sizes and for all seeds")
          ->type_name("SPEC");
  command.add_option("--grains", options->grains, "Sizes of these packings [of the specification]")
      ->delimiter(',')
      ->type_name("N,N,...")
      ->allow_extra_args(false)
      ->check(CLI::Range(4, 20000))
      ->needs(packing);
  command.add_option("--seeds", options->seeds, "Their seeds, a packing each [1,2,3]")
      ->delimiter(',')
      ->type_name("K,K,...")
      ->allow_extra_args(false)
      ->check(CLI::NonNegativeNumber)
      ->needs(packing);
  command
      .add_option("--band", options->band,
                  "Also compare the shear bands that form between these axial strains")
      ->delimiter(',')
      ->expected(2)
      ->type_name("FROM,TO")
      ->check(CLI::NonNegativeNumber)
      ->check(finite_number());
}

}  // namespace

Command add_bench(CLI::App& program, const Grains& grains) {
  const auto options = std::make_shared<BenchOptions>();
  options->directory = "bench-results";
  CLI::App& command = *program.add_subcommand("bench", "Measure speed against error over a grid of settings");
  command
      .add_option(
          "CASE", options->cases,
          "Case whose settings are varied; further cases are compared with it [the demo, with packings]")
      ->expected(0, -1)
      ->transform(brought_along);
  command.add_flag("--quick", options->quick, "Fewer settings; some minutes where no case is named");
  command.add_flag("--resume", options->resume, "Go on where a bench with the same settings was broken off");
  command.add_option("-o,--output", options->directory, "Result directory [bench-results]")->type_name("DIR");
  add_workers(command, options->workers, 1);
  command.add_option("--x", options->x, "Monitor along the curve [first of the case's table]")
      ->type_name("NAME");
  command.add_option("--y", options->y, "Monitor to compare; may be repeated [the others]")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command.add_option("--vary", options->vary, "Further values of a key, tried one at a time")
      ->type_name("KEY=A,B,...")
      ->allow_extra_args(false);
  command.add_option("--packing", options->packings, "A further packing to try; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_comparisons(command, *options);
  command.add_flag("--quiet", options->quiet, "Print nothing but errors");
  add_settings(command, options->settings);
  add_trust(command, options->scripts, grains);
  return {&command, [options, &tools = grains.packing_tools] {
            if (options->cases.empty()) take_demo(*options);
            return bench(*options, tools);
          }};
}

}  // namespace polargrain::app
