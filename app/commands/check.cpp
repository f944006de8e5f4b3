// SPDX-License-Identifier: GPL-2.0-or-later
#include <memory>

#include "app/commands/command.hpp"
#include "app/picture/case_picture.hpp"
#include "app/remarks/remarks.hpp"
#include "app/remarks/sizes.hpp"
#include "common/error.hpp"
#include "common/standard_streams.hpp"
#include "common/write_file.hpp"
#include "coupler/case/document_kind.hpp"

namespace polargrain::app {
namespace {

struct CheckOptions {
  std::filesystem::path case_file;
  std::filesystem::path picture;
  std::vector<std::string> settings;
  ScriptRules scripts;
  bool strict = false;
  bool all = false;
};

void tell_cells(const coupler::Case& the_case, const PackingsAtRest& packings) {
  if (the_case.check_share > 0.0 && the_case.needs_workers())
    tell(stdout,
         "{:.3g} % of the evaluations are made by two workers; one worker alone checks no evaluation\n",
         100.0 * the_case.check_share);
  for (const auto& [name, packing] : packings)
    tell(stdout, "material '{}': moduli of the packing at rest: {}\n", name, packing.moduli.text());
}

/// The size of the mesh in words.
template <int dim>
std::string size_of(const fem::Mesh<dim>& mesh) {
  if constexpr (dim == 2) {
    return fmt::format("{} elements, {} nodes", mesh.elements.size(), mesh.nodes.size());
  } else {
    return fmt::format("{} elements in space, {} nodes, {} unknowns", mesh.elements.size(), mesh.nodes.size(),
                       fem::entry_of<3>(mesh.nodes.size()));
  }
}

int check(const CheckOptions& options) {
  const coupler::Case the_case = coupler::read_case(options.case_file, options.settings, options.scripts);
  const coupler::Entry document =
      coupler::load_document_of(coupler::DocumentKind::problem, options.case_file, options.settings);
  check_page("--picture", options.picture,
             files_read_with(coupler::DocumentKind::problem, options.case_file, options.settings));
  // Each script and packing in an engine, before anything is said to be well.
  const PackingsAtRest packings = packings_at_rest(the_case, options.scripts.trusted);
  const Scene scene(the_case, document, packings);
  const Remarks remarks = remarks_on(scene);
  // Also where remarks refuse the case: it is then that somebody looks.
  if (!options.picture.empty()) write_file(options.picture, case_picture(scene, remarks));
  if (options.strict) refuse(remarks);
  tell(stdout, "{}: no faults; {}, {} steps, {}\n", options.case_file.string(),
       the_case.with_problem([](const auto& problem) { return size_of(problem.mesh); }), the_case.steps(),
       the_case.needs_workers() ? "needs workers" : "needs no workers");
  tell_cells(the_case, packings);
  tell(stdout, "{}{}", sizes_text(scene), text_of(remarks, options.all));
  return 0;
}

}  // namespace

Command add_check(CLI::App& program, const Grains& grains) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App& command =
      *program.add_subcommand("check", "Report all faults of a case and remarks on it; take no step");
  add_case(command, options->case_file);
  add_strict(command, options->strict);
  command.add_flag("--all", options->all, "Show all remarks, not the most serious alone");
  command
      .add_option("--picture", options->picture,
                  "Write a page with the mesh, supports, movements, loads and grains")
      ->type_name("FILE.html");
  add_settings(command, options->settings);
  add_trust(command, options->scripts, grains);
  return {&command, [options] { return check(*options); }};
}

}  // namespace polargrain::app
