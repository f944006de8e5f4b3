// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/commands/command.hpp"
#include "app/commands/independent_seeds.hpp"
#include "app/layer/measure.hpp"
#include "app/remarks/lengths.hpp"
#include "common/error.hpp"

namespace polargrain::app {
namespace {

void add_sizes(CLI::App& command, LayerOptions& to) {
  LayerOptions* const options = &to;
  command.add_option("--grains", options->grains, "Grains of a layer [1600: 40 diameters high and wide]")
      ->type_name("N")
      ->check(CLI::Range(100, 1000000));
  command.add_option("--seeds", options->seeds, "A layer each [1,...,10]")
      ->delimiter(',')
      ->type_name("K,K,...");
  command.add_option("--cell-grains", options->cell_grains, "Grains of a cell [100]")
      ->type_name("N")
      ->check(CLI::Range(16, 20000));
  command.add_option("--cell-seeds", options->cell_seeds, "A packing of cells each [1,...,5]")
      ->delimiter(',')
      ->type_name("K,K,...");
  command.add_option("--shear", options->shear, "Of a layer: displacement over height [0.16]")
      ->type_name("S")
      ->check(CLI::Range(0.01, 10.0))
      ->check(finite_number());
  command.add_option("--inertial-number", options->inertial_number, "Of a layer [2e-4]")
      ->type_name("I")
      ->check(CLI::Range(1e-6, 0.1))
      ->check(finite_number());
  command.add_option("--way", options->way, "Past the peak, over which layers and columns are compared [4]")
      ->type_name("D")
      ->check(CLI::Range(1.0, 1000.0))
      ->check(finite_number());
  command.add_option("--column", options->column_height, "Height of a column of cells [20]")
      ->type_name("D")
      ->check(CLI::Range(2.0, 1000.0))
      ->check(finite_number());
  command.add_option("--elements", options->elements, "Of a column [10]")
      ->type_name("N")
      ->check(CLI::Range(4, 1000));
}

/// Candidates grow, so that what lies between two can be told.
void check_candidates(const std::vector<double>& lengths, const char* option) {
  for (std::size_t k = 1; k < lengths.size(); ++k)
    if (!(lengths[k] > lengths[k - 1]))
      throw InputError(
          {option, 0, "candidates must grow from one to the next; give them in order, each once"});
}

/// A band of slips is no narrower than its elements let it be.
void check_elements(const LayerOptions& options) {
  const double element = options.column_height / options.elements;
  if (!options.spreads.empty() && element > kMostElementOverSpread * options.spreads.front())
    throw InputError(
        {"--spread", 0,
         fmt::format("{:g} diameters need elements of {:g} or less, a column has them of {:g}; give more "
                     "--elements, or wider spreads",
                     options.spreads.front(), kMostElementOverSpread * options.spreads.front(), element)});
}

}  // namespace

Command add_layer(CLI::App& program, const Grains& grains) {
  const auto options = std::make_shared<LayerOptions>();
  options->directory = "layer-results";
  CLI::App& command = *program.add_subcommand(
      "layer",
      "Measure the lengths of grains: layers of them against columns of cells\nLengths are in mean diameters of "
      "the grains. Existing results are kept: the same command goes on.");
  command
      .add_option("SPEC", options->specification,
                  "Specification of the packings (YAML); its script is the contact law")
      ->required()
      ->transform(brought_along);
  command.add_option("-o,--output", options->directory, "Result directory [layer-results]")->type_name("DIR");
  command
      .add_option("--beside", options->beside,
                  "A packing of such grains that gets the lengths too; may be repeated")
      ->type_name("PACKING")
      ->allow_extra_args(false);
  command.add_option("--lc", options->internal_lengths, "Internal lengths to try [0.2,0.4,0.8]")
      ->delimiter(',')
      ->type_name("D,D,...")
      ->check(CLI::PositiveNumber)
      ->check(finite_number());
  CLI::Option* const plastic =
      command.add_option("--lp", options->plastic_lengths, "Plastic lengths to try [0.25,0.5,1]")
          ->delimiter(',')
          ->type_name("D,D,...")
          ->check(CLI::PositiveNumber)
          ->check(finite_number());
  const auto elastic = std::make_shared<bool>(false);
  command.add_flag("--no-lp", *elastic, "No limit of the couple stress: lc alone is sought")
      ->excludes(plastic);
  CLI::Option* const spreads =
      command.add_option("--spread", options->spreads, "Spreads of slips to try [4,6,9]")
          ->delimiter(',')
          ->type_name("D,D,...")
          ->check(CLI::PositiveNumber)
          ->check(finite_number());
  const auto local = std::make_shared<bool>(false);
  command.add_flag_callback(
      "--no-columns", [options] { options->columns = false; }, "Shear layers and no columns of cells");
  command.add_flag("--no-spread", *local, "No column spreads its slips")->excludes(spreads);
  add_sizes(command, *options);
  add_workers(command, options->workers, 1);
  command.add_flag("--quiet", options->quiet, "Print nothing but errors");
  add_settings(command, options->settings);
  add_trust(command, options->scripts, grains);
  return {&command, [options, elastic, local, &tools = grains.packing_tools] {
            if (*elastic) options->plastic_lengths.clear();
            if (*local) options->spreads.clear();
            check_candidates(options->internal_lengths, "--lc");
            check_candidates(options->plastic_lengths, "--lp");
            check_candidates(options->spreads, "--spread");
            check_elements(*options);
            if (options->seeds.size() < 2)
              throw InputError({"--seeds", 0, "one layer does not show the scatter; give two seeds or more"});
            check_independent_seeds(options->seeds, "--seeds");
            check_independent_seeds(options->cell_seeds, "--cell-seeds");
            return measure_layer(*options, tools);
          }};
}

}  // namespace polargrain::app
