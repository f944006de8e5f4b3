// SPDX-License-Identifier: GPL-2.0-or-later
#include <memory>

#include "app/commands/command.hpp"
#include "app/commands/moduli.hpp"
#include "common/standard_streams.hpp"
#include "coupler/case/case.hpp"

namespace polargrain::app {
namespace {

struct CheckOptions {
  std::filesystem::path case_file;
  std::vector<std::string> settings;
  ScriptRules scripts;
};

int check(const CheckOptions& options) {
  const coupler::Case the_case = coupler::read_case(options.case_file, options.settings, options.scripts);
  std::vector<const CellDefinition*> cells;
  for (const auto& [name, material] : the_case.materials)
    if (material->needs_workers()) cells.push_back(material->grains());
  // Each script and packing in an engine, before anything is said to be well.
  const std::vector<std::string> lines = moduli_of(cells, options.scripts.trusted);
  tell(stdout, "{}: no faults; {} elements, {} nodes, {} steps, {}\n", options.case_file.string(),
       the_case.problem.mesh.elements.size(), the_case.problem.mesh.nodes.size(), the_case.steps(),
       the_case.needs_workers() ? "needs workers" : "needs no workers");
  if (the_case.check_share > 0.0 && the_case.needs_workers())
    tell(stdout, "{:.3g} % of the evaluations are made by two workers; with one worker nothing is checked\n",
         100.0 * the_case.check_share);
  for (std::size_t k = 0; k < lines.size(); ++k)
    tell(stdout, "material '{}': {}\n", cells[k]->name, lines[k]);
  return 0;
}

}  // namespace

Command add_check(CLI::App& program, const Grains& grains) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App& command = *program.add_subcommand("check", "Report all faults of a case; take no step");
  add_case(command, options->case_file);
  add_settings(command, options->settings);
  add_trust(command, options->scripts, grains);
  return {&command, [options] { return check(*options); }};
}

}  // namespace polargrain::app
