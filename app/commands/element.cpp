// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <memory>
#include <sstream>
#include <utility>

#include "app/commands/command.hpp"
#include "app/commands/csv_file.hpp"
#include "app/element/element_page.hpp"
#include "app/element/element_remarks.hpp"
#include "app/element/envelope.hpp"
#include "app/element/run_element.hpp"
#include "app/element/undrained_figures.hpp"
#include "app/pack/made_packings.hpp"
#include "app/remarks/remarks.hpp"
#include "common/error.hpp"
#include "common/standard_streams.hpp"
#include "common/write_file.hpp"
#include "coupler/case/case_identity.hpp"
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

/// One pressure, or a list with commas.
coupler::Entry pressures_of(const std::string& text) {
  if (text.find(',') == std::string::npos) return word(text, "--pressure");
  coupler::Entry list;
  list.kind = coupler::Entry::Kind::sequence;
  list.file = "--pressure";
  std::istringstream items(text);
  for (std::string item; std::getline(items, item, ',');) list.items.push_back(word(item, "--pressure"));
  return list;
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
  if (!options.pressure.empty()) put(document, "pressure", pressures_of(options.pressure));
  for (const std::string& setting : options.settings) apply_setting(document, setting);
  return document;
}

std::filesystem::path with_ending(const std::filesystem::path& output, const std::string& ending) {
  std::filesystem::path file = output;
  file += ending;
  return file;
}

/// The tests under the pressures of a specification: the same but for the pressure.
struct Tests {
  std::vector<double> pressures;  ///< Pa
  std::vector<ElementResult> results;
  std::vector<ElementMean> means;
  Envelopes envelopes = {};  ///< under several pressures, of tests that may bring their material to failure
  /// Under several pressures all tables say which.
  [[nodiscard]] bool are_several() const { return pressures.size() > 1; }
  [[nodiscard]] bool has_envelope() const { return !envelopes.at_states.empty(); }
};

/// A document for each pressure of a list.
std::vector<coupler::Entry> by_pressure(const coupler::Entry& document) {
  const coupler::Entry* const pressures = document.find("pressure");
  if (pressures == nullptr || pressures->kind != coupler::Entry::Kind::sequence || pressures->items.empty())
    return {document};
  std::vector<coupler::Entry> documents;
  for (const coupler::Entry& pressure : pressures->items) {
    documents.push_back(document);
    put(documents.back(), "pressure", pressure);
  }
  return documents;
}

std::string table_of(const Tests& tests) {
  std::vector<std::string> titles{"packing"};
  if (tests.are_several()) titles.emplace_back("pressure_Pa");
  const std::vector<std::string>& columns = tests.results.front().columns;
  titles.insert(titles.end(), columns.begin(), columns.end());
  std::string text = csv_row(titles);
  for (std::size_t k = 0; k < tests.results.size(); ++k)
    for (const ElementCurve& curve : tests.results[k].curves)
      for (const std::vector<double>& row : curve.rows) {
        std::vector<std::string> cells{curve.name};
        if (tests.are_several()) cells.push_back(exact(tests.pressures[k]));
        for (const double value : row) cells.push_back(exact(value));
        text += csv_row(cells);
      }
  return text;
}

/// Empty: no two specimens came anywhere.
std::string table_of_means(const Tests& tests) {
  const std::vector<std::string>& columns = tests.results.front().columns;
  std::string titles = tests.are_several() ? "n,pressure_Pa" : "n";
  for (const std::string& name : columns) titles += fmt::format(",{0},{0}_half_95", name);
  std::string text;
  for (std::size_t t = 0; t < tests.means.size(); ++t) {
    const ElementMean& mean = tests.means[t];
    for (std::size_t k = 0; k < mean.mean.size(); ++k) {
      text += std::to_string(mean.count[k]);
      if (tests.are_several()) text += "," + exact(tests.pressures[t]);
      for (std::size_t c = 0; c < columns.size(); ++c)
        text += "," + exact(mean.mean[k][c]) + "," + exact(mean.half_width[k][c]);
      text += '\n';
    }
  }
  return text.empty() ? text : titles + '\n' + text;
}

/// The page of all tests: under several pressures the curves of the specimens, named with theirs, and no mean over pressures.
std::string page_of(const std::string& title, const Tests& tests) {
  const std::vector<std::string>& columns = tests.results.front().columns;
  if (!tests.are_several())
    return element_page(title, columns, tests.results.front().curves, tests.means.front());
  std::vector<ElementCurve> curves;
  for (std::size_t k = 0; k < tests.results.size(); ++k)
    for (ElementCurve curve : tests.results[k].curves) {
      curve.name += fmt::format(" at {:.4g} kPa", 1e-3 * tests.pressures[k]);
      curves.push_back(std::move(curve));
    }
  return element_page(title, columns, curves, {}, envelope_charts(tests.envelopes));
}

std::string summary_of(const Tests& tests) {
  std::string text;
  for (std::size_t k = 0; k < tests.results.size(); ++k) {
    if (tests.are_several()) text += fmt::format("under {:.4g} kPa\n", 1e-3 * tests.pressures[k]);
    text += summary_of(tests.results[k]) + undrained_summary(tests.results[k]);
  }
  if (tests.are_several())
    text += tests.has_envelope() ? envelope_summary(tests.envelopes) : why_no_envelope();
  return text;
}

/// @returns whether all tests came to their end
bool tell_failures(const Tests& tests) {
  bool is_whole = true;
  for (std::size_t k = 0; k < tests.results.size(); ++k)
    for (const ElementCurve& curve : tests.results[k].curves) {
      if (curve.failure.empty()) continue;
      is_whole = false;
      const std::string where =
          tests.are_several() ? fmt::format("{} under {:.4g} kPa", curve.name, 1e-3 * tests.pressures[k])
                              : curve.name;
      tell(stderr, "error: {}: {}\n", where, curve.failure);
    }
  return is_whole;
}

/// Writes a companion of the table. If its text is empty, the file of an older run is removed: it would tell of other curves.
void write_companion(const std::filesystem::path& file, const std::string& text) {
  std::error_code error;
  if (!text.empty())
    write_file(file, text);
  else if (std::filesystem::remove(file, error); error)
    throw RunError(fmt::format("{} of an older run cannot be removed: {}", file.string(), error.message()));
}

void write_files(const std::filesystem::path& output, const std::string& title, const Tests& tests) {
  write_file(with_ending(output, ".csv"), table_of(tests));
  write_companion(with_ending(output, "_mean.csv"), table_of_means(tests));
  write_companion(with_ending(output, "_envelope.csv"),
                  tests.has_envelope() ? envelope_table(tests.envelopes) : "");
  write_file(with_ending(output, ".html"), page_of(title.empty() ? "Element test" : title, tests));
}

int run_test(const ElementOptions& options, const PackingTools& tools) {
  const coupler::Entry document = document_of(options);
  const std::filesystem::path directory = is_yaml(options.files.front())
                                              ? std::filesystem::path(document.file).parent_path()
                                              : std::filesystem::current_path();
  const coupler::PrivateDirectory scratch;
  const auto read = [&](const PackingsOf& packings_of) {
    std::vector<ElementSpecification> specifications;
    for (const coupler::Entry& one : by_pressure(document))
      specifications.push_back(read_element_specification(
          with_made_packings(one, directory, options.scripts, packings_of), directory, options.scripts));
    return specifications;
  };
  // All faults are found before the first packing is made.
  read([&scratch](const MadePackings& asked) { return stand_ins(asked, scratch.path()); });
  std::vector<std::filesystem::path> inputs = coupler::files_named_in(document, directory);
  inputs.emplace_back(document.file);
  for (const auto& [ending, beginning] :
       {std::pair{".csv", "packing,"}, {"_mean.csv", "n,"}, {"_envelope.csv", "packing,state,"}})
    check_table("-o", with_ending(options.output, ending), inputs, beginning);
  check_page("-o", with_ending(options.output, ".html"), inputs);
  const std::vector<ElementSpecification> specifications = read([&](const MadePackings& asked) {
    return make_packings(asked, options.packings, tools, [&options](const std::string& line) {
      if (!options.quiet) tell(stderr, "{}\n", line);
    });
  });
  if (!options.quiet)
    for (const Remark& remark : remarks_on_element(document, specifications))
      tell(stdout, "{}\n", line_of(remark));
  Tests tests;
  for (const ElementSpecification& one : specifications) tests.pressures.push_back(one.pressure);
  tests.results = run_elements(specifications, options.workers, options.scripts.trusted);
  for (const ElementResult& result : tests.results) tests.means.push_back(mean_of(result.curves));
  if (tests.are_several() && can_fail(specifications.front()))
    tests.envelopes = envelopes_of(tests.results, tests.pressures);
  write_files(options.output, specifications.front().title, tests);
  if (!options.quiet) tell(stdout, "{}", summary_of(tests));
  return tell_failures(tests) ? 0 : 1;
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
  command
      .add_option("--pressure", options->pressure,
                  "All-round pressure before the test, with its unit; of several an envelope")
      ->type_name("100kPa[,200kPa]");
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
