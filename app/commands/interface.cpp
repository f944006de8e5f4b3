// SPDX-License-Identifier: GPL-2.0-or-later
#include <memory>

#include "app/commands/command.hpp"
#include "app/commands/independent_seeds.hpp"
#include "app/layer/measure_interface.hpp"
#include "common/error.hpp"

namespace polargrain::app {

Command add_interface(CLI::App& program, const Grains& grains) {
  const auto options = std::make_shared<InterfaceOptions>();
  options->directory = "interface-results";
  CLI::App& command = *program.add_subcommand(
      "interface",
      "Measure the friction of grains on rough walls\nLengths are in mean diameters of the grains. Existing results "
      "are kept: the same command goes on.");
  command
      .add_option("SPEC", options->specification,
                  "Specification of the packings (YAML); its script is the contact law")
      ->required()
      ->transform(brought_along);
  command.add_option("-o,--output", options->directory, "Result directory [interface-results]")
      ->type_name("DIR");
  command
      .add_option("--beside", options->beside,
                  "A packing of such grains that gets the friction too; may be repeated")
      ->type_name("PACKING")
      ->allow_extra_args(false);
  command.add_option("--roughness", options->roughnesses, "Diameters of the grains of walls [0.25,0.5,1]")
      ->delimiter(',')
      ->type_name("D,D,...")
      ->check(CLI::Range(0.02, 3.0))
      ->check(finite_number());
  command.add_option("--grains", options->grains, "Of a packing [400: 20 diameters high and wide]")
      ->type_name("N")
      ->check(CLI::Range(100, 1000000));
  command.add_option("--height", options->height, "Of a box: the rest of its packing is taken off [10]")
      ->type_name("D")
      ->check(CLI::Range(6.0, 1000.0))
      ->check(finite_number());
  command.add_option("--seeds", options->seeds, "A box each on every wall [1,...,10]")
      ->delimiter(',')
      ->type_name("K,K,...");
  command.add_option("--way", options->way, "Slip [5]")
      ->type_name("D")
      ->check(CLI::Range(2.0, 1000.0))
      ->check(finite_number());
  command.add_option("--inertial-number", options->inertial_number, "[1e-3]")
      ->type_name("I")
      ->check(CLI::Range(1e-6, 0.1))
      ->check(finite_number());
  command.add_flag("--quiet", options->quiet, "Print nothing but errors");
  add_settings(command, options->settings);
  add_trust(command, options->scripts, grains);
  return {&command, [options, &tools = grains.packing_tools] {
            if (options->seeds.size() < 2)
              throw InputError({"--seeds", 0, "one box does not show the scatter; give two seeds or more"});
            check_independent_seeds(options->seeds, "--seeds");
            return measure_interface(*options, tools);
          }};
}

}  // namespace polargrain::app
