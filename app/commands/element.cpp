// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <memory>

#include "app/commands/command.hpp"
#include "app/commands/csv_file.hpp"
#include "app/element/element_page.hpp"
#include "app/element/run_element.hpp"
#include "app/pack/made_packings.hpp"
#include "common/regular_file.hpp"
#include "common/standard_streams.hpp"
#include "common/write_file.hpp"
#include "coupler/case/document.hpp"
#include "coupler/pool/private_directory.hpp"

namespace polargrain::app {
namespace {

struct ElementOptions {
  std::vector<std::string> files;  ///< a specification; or packings and their script
  std::string test;
  std::string pressure;
  std::filesystem::path output = "element";
  std::filesystem::path packings = "packings";
  std::vector<std::string> settings;
  int workers = 1;
  bool quiet = false;
  ScriptRules scripts = {};
};

bool is_yaml(const std::string& name) {
  const std::string ending = std::filesystem::path(name).extension().string();
  return ending == ".yaml" || ending == ".yml";
}

coupler::Entry word(const std::string& text, const std::string& option) {
  coupler::Entry entry;
  entry.kind = coupler::Entry::Kind::scalar;
  entry.text = text;
  entry.file = option;
  return entry;
}

void put(coupler::Entry& document, const std::string& key, coupler::Entry value) {
  std::erase_if(document.members, [&](const coupler::Entry::Member& member) { return member.key == key; });
  document.members.push_back({key, 0, std::move(value)});
}

/// The specification file, or one made of packings and a script; then what the options say.
coupler::Entry document_of(const ElementOptions& options) {
  coupler::Entry document;
  document.kind = coupler::Entry::Kind::map;
  document.file = "polargrain element";
  if (options.files.size() == 1 && is_yaml(options.files.front())) {
    document = coupler::load_document(brought_along(options.files.front()));
  } else {
    if (options.files.size() < 2)
      throw InputError(
          {"", 0, "element: name a specification (YAML), or at least one packing and then its script"});
    coupler::Entry packings;
    packings.kind = coupler::Entry::Kind::sequence;
    packings.file = document.file;
    for (std::size_t k = 0; k + 1 < options.files.size(); ++k)
      packings.items.push_back(word(options.files[k], document.file));
    put(document, "packing", std::move(packings));
    put(document, "script", word(options.files.back(), document.file));
  }
  if (!options.test.empty()) put(document, "test", word(options.test, "--test"));
  if (!options.pressure.empty()) put(document, "pressure", word(options.pressure, "--pressure"));
  for (const std::string& setting : options.settings) apply_setting(document, setting);
  return document;
}

std::filesystem::path with_ending(const std::filesystem::path& output, const std::string& ending) {
  std::filesystem::path file = output;
  file += ending;
  return file;
}

std::string table_of(const ElementResult& result) {
  std::vector<std::string> titles{"packing"};
  titles.insert(titles.end(), result.columns.begin(), result.columns.end());
  std::string text = csv_row(titles);
  for (const ElementCurve& curve : result.curves) {
    for (const std::vector<double>& row : curve.rows) {
      std::vector<std::string> cells{curve.name};
      for (const double value : row) cells.push_back(exact(value));
      text += csv_row(cells);
    }
  }
  return text;
}

std::string table_of(const std::vector<std::string>& columns, const ElementMean& mean) {
  std::string text = "n";
  for (const std::string& name : columns) text += fmt::format(",{0},{0}_half_95", name);
  text += '\n';
  for (std::size_t k = 0; k < mean.mean.size(); ++k) {
    text += std::to_string(mean.count[k]);
    for (std::size_t c = 0; c < columns.size(); ++c)
      text += "," + exact(mean.mean[k][c]) + "," + exact(mean.half_width[k][c]);
    text += '\n';
  }
  return text;
}

int run_test(const ElementOptions& options, const PackingTools& tools) {
  const coupler::Entry document = document_of(options);
  const std::filesystem::path directory = is_yaml(options.files.front())
                                              ? std::filesystem::path(document.file).parent_path()
                                              : std::filesystem::current_path();
  const coupler::PrivateDirectory scratch;
  const auto read = [&](const PackingsOf& packings_of) {
    return read_element_specification(with_made_packings(document, directory, options.scripts, packings_of),
                                      directory, options.scripts);
  };
  // All faults are found before the first packing is made.
  read([&scratch](const MadePackings& asked) { return stand_ins(asked, scratch.path()); });
  for (const char* const ending : {".csv", "_mean.csv", ".html"}) {
    if (const std::string reason = why_no_output(with_ending(options.output, ending)); !reason.empty())
      throw InputError({"", 0, fmt::format("-o {}: {}", options.output.string(), reason)});
  }
  ElementSpecification specification = read([&](const MadePackings& asked) {
    return make_packings(asked, options.packings, tools, [&options](const std::string& line) {
      if (!options.quiet) tell(stderr, "{}\n", line);
    });
  });
  const ElementResult result =
      run_elements({&specification, 1}, options.workers, options.scripts.trusted).front();
  const ElementMean mean = mean_of(result.curves);
  write_file(with_ending(options.output, ".csv"), table_of(result));
  if (!mean.mean.empty())
    write_file(with_ending(options.output, "_mean.csv"), table_of(result.columns, mean));
  const std::string title = specification.title.empty() ? "Element test" : specification.title;
  write_file(with_ending(options.output, ".html"), element_page(title, result.columns, result.curves, mean));
  if (!options.quiet) tell(stdout, "{}", summary_of(result));
  bool is_whole = true;
  for (const ElementCurve& curve : result.curves) {
    if (curve.failure.empty()) continue;
    is_whole = false;
    tell(stderr, "error: {}: {}\n", curve.name, curve.failure);
  }
  return is_whole ? 0 : 1;
}

std::string description() {
  std::string text =
      "Test one material point as a soil laboratory does: a cell of grains, or a law computed in place.\n\n"
      "  polargrain element --test biaxial --pressure 100kPa dense400.h5 cells/hooke_rolling.in\n"
      "  polargrain element --test simple_shear --pressure 50kPa --set shear_strain=5% a.h5 b.h5 cells/hooke_radii.in\n"
      "  polargrain element SPEC.yaml        stages, cycles, components: docs/element_tests.md\n\n"
      "Tests (--test, or test: in a specification):\n";
  for (const element::TestKind& kind : element::test_kinds())
    text += fmt::format("  {:<18}{}\n", kind.name, kind.summary);
  return text +
         "\nParameters (--set KEY=VALUE): axial_strain or deviator (10% and less: negative extends), shear_strain or "
         "shear_stress,\ncycles with amplitude (0.1% or 20kPa), drainage=undrained, b or lode, to, rows; tolerance, "
         "largest_increment, cuts, jumps.\nWrites NAME.csv, NAME.html (four curves) and, of several packings, "
         "NAME_mean.csv (n, mean, 95 %).";
}

}  // namespace

Command add_element(CLI::App& program, const Grains& grains) {
  const auto options = std::make_shared<ElementOptions>();
  CLI::App& command = *program.add_subcommand("element", "Laboratory tests of one material point");
  command.description(description());
  command.add_option("FILES", options->files, "Specification (YAML); or packings, then their script")
      ->required();
  command.add_option("--test", options->test, "Named test")->type_name("NAME");
  command.add_option("--pressure", options->pressure, "All-round pressure before the test, with its unit")
      ->type_name("100kPa");
  command.add_option("-o,--output", options->output, "Files to write: NAME.csv, NAME.html [element]")
      ->type_name("NAME");
  command
      .add_option("--packings", options->packings, "Folder that keeps the packings that are made [packings]")
      ->type_name("DIR");
  command.add_flag("--quiet", options->quiet, "Print nothing but errors");
  add_settings(command, options->settings);
  add_workers(command, options->workers, 1);
  add_trust(command, options->scripts, grains);
  return {&command, [options, &tools = grains.packing_tools] { return run_test(*options, tools); }};
}

}  // namespace polargrain::app
