// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/run.hpp"

#include <memory>

#include "app/commands/command.hpp"

namespace polargrain::app {

Command add_run(CLI::App& program, const Grains& grains) {
  const auto options = std::make_shared<RunOptions>();
  options->state_fault = grains.engine.state_fault;
  CLI::App& command = *program.add_subcommand("run", "Run a case");
  add_case(command, options->case_file);
  command.add_option("-o,--output", options->directory, "Result directory [results/NAME]")->type_name("DIR");
  add_workers(command, options->workers, 0);
  CLI::Option* listen = command
                            .add_option("--listen", options->listen,
                                        "Address at which workers of other machines may join: tcp://*:5570")
                            ->type_name("URL");
  listen->needs(command.add_option("--keys", options->keys, "Directory of 'polargrain keys', to listen")
                    ->type_name("DIR"));
  command.add_flag("--resume", options->resume, "Go on from the checkpoint in DIR");
  command
      .add_option("--checkpoint-minutes", options->checkpoint_minutes,
                  "Least time between two checkpoints; 0: one a step [of the case: 10]")
      ->type_name("MINUTES")
      ->check(CLI::NonNegativeNumber)
      ->check(finite_number());
  add_strict(command, options->strict);
  command.add_flag("--quiet", options->quiet, "Print nothing but errors");
  add_settings(command, options->settings);
  add_trust(command, options->scripts, grains);
  return {&command, [options] { return run(*options); }, false};
}

}  // namespace polargrain::app
