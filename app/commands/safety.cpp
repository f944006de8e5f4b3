// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/safety/safety.hpp"

#include <memory>

#include "app/commands/command.hpp"

namespace polargrain::app {

Command add_safety(CLI::App& program, const Grains& grains) {
  const auto options = std::make_shared<SafetyOptions>();
  CLI::App& command =
      *program.add_subcommand("safety", "Find the factor of safety of a case of laws by strength reduction");
  add_case(command, options->case_file);
  command
      .add_option("--stage", options->stage,
                  "Reduce strength at the end of this stage [at the end of the case]")
      ->type_name("NAME");
  command
      .add_option("--resolution", options->resolution,
                  "Largest distance between the factor that holds and the factor that fails [0.01]")
      ->type_name("NUMBER")
      ->check(CLI::Range(1e-6, 1.0))
      ->check(finite_number());
  command.add_option("--largest", options->largest, "Largest factor that is tried [10]")
      ->type_name("NUMBER")
      ->check(CLI::Range(1.0, 1e6))
      ->check(finite_number());
  command.add_option("-o,--output", options->file, "Write a table of the trials")->type_name("FILE.csv");
  add_settings(command, options->settings);
  add_trust(command, options->scripts, grains);
  return {&command, [options] {
            // Before a search that takes long.
            check_table(
                "-o", options->file,
                files_read_with(coupler::DocumentKind::problem, options->case_file, options->settings),
                "factor,stands,");
            return safety(*options);
          }};
}

}  // namespace polargrain::app
