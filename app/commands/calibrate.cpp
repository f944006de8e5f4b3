// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "app/calibrate/calibration_page.hpp"
#include "app/calibrate/doubts_of_curves.hpp"
#include "app/calibrate/script_parameters.hpp"
#include "app/commands/command.hpp"
#include "app/commands/csv_file.hpp"
#include "app/commands/pack.hpp"
#include "app/page/page.hpp"
#include "common/csv_table.hpp"
#include "common/packing_file.hpp"
#include "common/regular_file.hpp"
#include "common/standard_streams.hpp"
#include "common/write_file.hpp"
#include "coupler/pool/private_directory.hpp"

namespace polargrain::app {
namespace {

struct CalibrateOptions {
  std::filesystem::path laboratory;
  std::filesystem::path specification;
  std::filesystem::path directory = "calibration";
  std::filesystem::path packings = "packings";
  std::vector<std::string> settings;
  int workers = 1;
  bool quiet = false;
  ScriptRules scripts = {};
};

/// The tests under a script with these values.
std::vector<ElementSpecification> tests_with(const Calibration& calibration,
                                             const std::vector<double>& values) {
  std::vector<std::pair<std::string, double>> parameters;
  for (std::size_t k = 0; k < values.size(); ++k)
    parameters.emplace_back(calibration.parameters[k].name, values[k]);
  std::vector<ElementSpecification> tests = calibration.tests;
  for (ElementSpecification& test : tests)
    for (CellDefinition& cell : test.cells) cell.script = with_parameters(cell.script, parameters);
  return tests;
}

/// The name of a point, for messages.
std::string name_of_point(const Calibration& calibration, const TargetPoint& point) {
  const std::string of = fmt::format("{} of test '{}'", point.column, calibration.test_names[point.test]);
  return point.where == TargetPoint::Where::along ? fmt::format("{} at {} {:.4g}", of, point.along, point.at)
                                                  : of;
}

/// In one line, for a cell of a table.
std::string in_one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  std::ranges::replace(text, '"', '\'');
  return text;
}

/// A search among points that no test can reach would go on to its end and say nothing.
void tell_missed(const Calibration& calibration, const std::vector<std::size_t>& missed) {
  if (missed.empty()) return;
  const auto is_along = [&](const TargetPoint& point) { return point.where == TargetPoint::Where::along; };
  const auto missed_along =
      std::ranges::count_if(missed, [&](std::size_t k) { return is_along(calibration.points[k]); });
  if (missed_along > 0 && missed_along == std::ranges::count_if(calibration.points, is_along))
    throw RunError(fmt::format(
        "no test comes as far as the points of the laboratory, the first is {}: correct the end of the test, or the unit of the "
        "table ('factor_along' of the target, 0.01 for per cent)",
        name_of_point(calibration, calibration.points[missed.front()])));
  tell(
      stderr,
      "warning: {} of {} points lie where not all packings came, the first is {}; each counts as {:g} errors a packing. Where "
      "the test ends before them, let it end later, or leave them out with 'to' of the target\n",
      missed.size(), calibration.points.size(),
      name_of_point(calibration, calibration.points[missed.front()]), kMissed);
}

/// A test that broke off says nothing of its end.
void tell_broken(const Calibration& calibration, const std::vector<ElementResult>& results,
                 const std::string& when) {
  for (std::size_t k = 0; k < results.size(); ++k) {
    const auto is_broken = [](const ElementCurve& curve) { return !curve.failure.empty(); };
    const auto first = std::ranges::find_if(results[k].curves, is_broken);
    if (first == results[k].curves.end()) continue;
    tell(
        stderr,
        "warning: test '{}' broke off {} in {} of {} packings: '{}': {}; each point that it did not reach counts as {:g} "
        "errors a packing. Let the test end earlier, or narrow 'bounds'\n",
        calibration.test_names[k], when, std::ranges::count_if(results[k].curves, is_broken),
        results[k].curves.size(), first->name, in_one_line(first->failure), kMissed);
  }
}

/// Contacts of another stiffness leave grains out of rest, where a test would not begin: brought to rest under the script
/// and the pressure of the test, from the packing as it was made.
void settle(std::vector<ElementSpecification>& tests, const PackingTools& tools) {
  const coupler::PrivateDirectory scratch;
  const std::filesystem::path file = scratch.path() / "settled.h5";
  for (ElementSpecification& test : tests)
    for (CellDefinition& cell : test.cells) {
      PackingSpecification specification;
      specification.dimension = cell.packing.dimension;
      specification.pressure = test.pressure;
      specification.script = cell.script;
      specification.script_file = cell.script_file;
      specification.contact_library = cell.contact_library;
      PreparedPacking as_made;
      as_made.packing = cell.packing;
      as_made.reached.pressure = test.pressure;
      make_packing_file([&](const auto& progress) { return tools.settle(specification, as_made, progress); },
                        file, tools, true);
      cell.packing = read_packing_file(file).packing;
      cell.packing.pressure = 0.0;
    }
}

/// The tests; with packings that are settled where those as they are do not begin.
std::vector<ElementResult> run_tests(std::vector<ElementSpecification> tests, const CalibrateOptions& options,
                                     const PackingTools& tools) {
  try {
    return run_elements(tests, options.workers, options.scripts.trusted);
  } catch (const NotAtRest&) {
    settle(tests, tools);
    return run_elements(tests, options.workers, options.scripts.trusted);
  }
}

constexpr const char* kBeginningOfScript = "# found by polargrain calibrate\n";

std::string with_beginning(const std::string& script) {
  return script.starts_with(kBeginningOfScript) ? script : kBeginningOfScript + script;
}

/// best.in; of a test with another script best_TEST.in too.
void write_scripts(const Calibration& calibration, const std::vector<ElementSpecification>& tests,
                   const std::filesystem::path& directory) {
  const std::string& first = tests.front().cells.front().script;
  write_file(directory / "best.in", with_beginning(first));
  for (std::size_t k = 1; k < tests.size(); ++k)
    if (const std::string& script = tests[k].cells.front().script; script != first)
      write_file(directory / fmt::format("best_{}.in", calibration.test_names[k]), with_beginning(script));
}

/// @param first tell of points that the tests did not reach
Answer evaluate(const Calibration& calibration, const std::vector<double>& values,
                const CalibrateOptions& options, const PackingTools& tools, bool first) {
  const std::vector<ElementSpecification> tests = tests_with(calibration, values);
  std::vector<std::vector<std::string>> columns;
  std::vector<std::vector<std::vector<std::vector<double>>>> curves;
  std::vector<ElementResult> results;
  try {
    results = run_tests(tests, options, tools);
  } catch (const RunError& error) {
    // The values that the user began with must run; a search may go astray.
    if (first) throw;
    return {std::vector<double>(calibration.points.size(), kMissed), in_one_line(error.what())};
  }
  for (const ElementResult& result : results) {
    columns.push_back(result.columns);
    curves.emplace_back();
    for (const ElementCurve& curve : result.curves) curves.back().push_back(curve.rows);
  }
  if (first) {
    if (const auto again = point_passed_again(calibration.points, columns, curves))
      throw RunError(told_as_passed_again(calibration, calibration.points[*again]));
    tell_broken(calibration, results, "with the values of 'start'");
    tell_missed(calibration, missed_points(calibration.points, columns, curves));
    for (const std::string& doubt : doubts_of_curves(calibration, columns, curves))
      tell(stderr, "warning: {}\n", doubt);
  }
  return {differences(calibration.points, columns, curves)};
}

std::vector<std::string> columns_of_record(const Calibration& calibration) {
  std::vector<std::string> columns;
  for (const Parameter& parameter : calibration.parameters) columns.push_back(parameter.name);
  columns.emplace_back("misfit");
  for (std::size_t k = 0; k < calibration.points.size(); ++k)
    columns.push_back(fmt::format("difference_{}", k + 1));
  columns.emplace_back("left_out");
  return columns;
}

std::vector<std::string> cells_of(const Evaluation& evaluation) {
  std::vector<std::string> cells;
  for (const double value : evaluation.values) cells.push_back(exact(value));
  cells.push_back(exact(evaluation.misfit));
  for (const double difference : evaluation.differences) cells.push_back(exact(difference));
  cells.push_back(evaluation.left_out);
  return cells;
}

constexpr const char* kBeginningOfRecord = "# calibration ";

std::string heading_of(const Calibration& calibration) {
  return fmt::format("{}{}\n{}", kBeginningOfRecord, calibration.identity,
                     csv_row(columns_of_record(calibration)));
}

/// The evaluations that a record holds. @throws InputError when it is one of another calibration
std::vector<Evaluation> known_evaluations(const std::filesystem::path& record,
                                          const Calibration& calibration) {
  if (!std::filesystem::exists(record)) return {};
  const CsvTable table(record);
  if (table.comments().empty() || table.comments().front() != kBeginningOfRecord + calibration.identity)
    throw InputError(
        {record.string(), 1,
         "is the record of another calibration: its table, specification, script or packings were "
         "different; name another folder with -o, or remove it"});
  std::vector<Evaluation> known;
  const std::size_t count = calibration.parameters.size();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    Evaluation one;
    for (std::size_t k = 0; k < count; ++k) one.values.push_back(table.number(row, k));
    one.misfit = table.number(row, count);
    for (std::size_t k = 0; k < calibration.points.size(); ++k)
      one.differences.push_back(table.number(row, count + 1 + k));
    if (table.names().back() == "left_out") one.left_out = table.cell(row, "left_out");
    known.push_back(std::move(one));
  }
  return known;
}

std::string table_of(const Calibration& calibration, const CalibrationResult& result) {
  std::string text = "parameter,best,low_95,high_95\n";
  for (std::size_t k = 0; k < calibration.parameters.size(); ++k) {
    const Parameter& parameter = calibration.parameters[k];
    const double place = parameter.place_of(result.best.values[k]);
    text += csv_row({parameter.name, exact(result.best.values[k]),
                     exact(parameter.value_at(place - result.half_width[k])),
                     exact(parameter.value_at(place + result.half_width[k]))});
  }
  return text;
}

/// The files of the folder have usual names, which those that it reads may have too. @throws InputError
void check_folder(const CalibrateOptions& options, const Calibration& calibration) {
  std::vector<std::filesystem::path> inputs =
      files_read_with(coupler::DocumentKind::calibration, options.specification, options.settings);
  inputs.push_back(options.laboratory);
  const auto refuse = [&](const std::string& name, const std::string& reason) {
    if (!reason.empty()) throw InputError({(options.directory / name).string(), 0, reason});
  };
  std::vector<std::string> scripts{"best.in"};
  for (std::size_t k = 1; k < calibration.test_names.size(); ++k)
    scripts.push_back(fmt::format("best_{}.in", calibration.test_names[k]));
  std::vector<std::string> names{"record.csv", "parameters.csv", "profile.csv", "calibration.html"};
  names.insert(names.end(), scripts.begin(), scripts.end());
  for (const std::string& name : names) {
    const std::string reason = why_not_over(options.directory / name, inputs);
    refuse(name, reason.empty() ? reason : reason + ", or another folder with -o");
  }
  const std::string remedy = "name another folder with -o, or remove it";
  const auto keep_others = [&](const std::string& name, const char* beginning, const char* what) {
    const std::string reason = why_not_own(options.directory / name, beginning, what);
    refuse(name, reason.empty() ? reason : reason + "; " + remedy);
  };
  for (const auto& [name, beginning] : {std::pair{"record.csv", kBeginningOfRecord},
                                        {"parameters.csv", "parameter,"},
                                        {"profile.csv", "held,"}})
    keep_others(name, beginning, "table of this command");
  for (const std::string& name : scripts) keep_others(name, kBeginningOfScript, "script of this command");
  refuse("calibration.html", why_no_page(options.directory / "calibration.html", remedy));
}

/// All faults are found before the first packing is made.
Calibration read_and_make_packings(const CalibrateOptions& options, const PackingTools& tools) {
  if (options.specification.extension() == ".csv" && options.laboratory.extension() != ".csv")
    throw InputError({options.specification.string(), 0,
                      fmt::format("the two files are exchanged; write polargrain calibrate {} {}",
                                  options.specification.string(), options.laboratory.string())});
  const coupler::PrivateDirectory scratch;
  const auto read = [&options](const PackingsOf& packings_of) {
    return read_calibration(options.laboratory, options.specification, options.settings, options.scripts,
                            packings_of);
  };
  check_folder(options,
               read([&scratch](const MadePackings& asked) { return stand_ins(asked, scratch.path()); }));
  return read([&](const MadePackings& asked) {
    return make_packings(asked, options.packings, tools, [&options](const std::string& line) {
      if (!options.quiet) tell(stderr, "{}\n", line);
    });
  });
}

std::string profile_of(const Calibration& calibration, const CalibrationResult& result) {
  std::vector<std::string> names;
  for (const Parameter& parameter : calibration.parameters) names.push_back(parameter.name);
  std::vector<std::string> titles{"held"};
  titles.insert(titles.end(), names.begin(), names.end());
  titles.insert(titles.end(), {"misfit", "within_95"});
  std::string text = csv_row(titles);
  for (const ProfilePoint& point : result.profile) {
    std::vector<std::string> cells{names[point.parameter]};
    for (const double value : point.values) cells.push_back(exact(value));
    cells.push_back(exact(point.misfit));
    cells.emplace_back(point.misfit <= result.threshold ? "1" : "0");
    text += csv_row(cells);
  }
  return text;
}

int run_calibration(const CalibrateOptions& options, const PackingTools& tools) {
  const Calibration calibration = read_and_make_packings(options, tools);
  std::filesystem::create_directories(options.directory);
  const std::filesystem::path file = options.directory / "record.csv";
  const std::vector<Evaluation> known = known_evaluations(file, calibration);
  std::string text = heading_of(calibration);
  for (const Evaluation& one : known) text += csv_row(cells_of(one));
  CsvFile record(file, text);
  std::size_t count = known.size();
  bool first = known.empty();
  const CalibrationResult result = calibrate(
      calibration,
      [&](const std::vector<double>& values) {
        return evaluate(calibration, values, options, tools, std::exchange(first, false));
      },
      known,
      [&](const Evaluation& one) {
        record.row(cells_of(one));
        if (!one.left_out.empty())
          tell(stderr, "warning: evaluation {}: {:.4g}: left out, the tests could not be run: {}\n", ++count,
               fmt::join(one.values, ", "), one.left_out);
        else if (!options.quiet)
          tell(stderr, "evaluation {}: {:.4g}, difference {:.4g} errors\n", ++count,
               fmt::join(one.values, ", "), std::sqrt(one.misfit));
      });
  const std::vector<ElementSpecification> tests = tests_with(calibration, result.best.values);
  const std::vector<ElementResult> best = run_tests(tests, options, tools);
  tell_broken(calibration, best, "with the best values");
  write_file(options.directory / "parameters.csv", table_of(calibration, result));
  if (!result.profile.empty()) write_file(options.directory / "profile.csv", profile_of(calibration, result));
  write_scripts(calibration, tests, options.directory);
  write_file(options.directory / "calibration.html", calibration_page(calibration, result, best));
  tell(stdout, "{}", calibration_summary(calibration, result));
  return result.converged ? 0 : 1;
}

}  // namespace

Command add_calibrate(CLI::App& program, const Grains& grains) {
  const auto options = std::make_shared<CalibrateOptions>();
  CLI::App& command =
      *program.add_subcommand("calibrate", "Find parameters of contacts from laboratory curves");
  command.description(
      "Find parameters of contacts from laboratory curves\n"
      "The parameters are variables of a script of cells (docs/element_tests.md). Writes record.csv (a row an evaluation; the same command goes on from there),\n"
      "parameters.csv (with 95 % intervals), best.in (the script) and calibration.html. Exit status 1: not converged.");
  command.add_option("LAB", options->laboratory, "CSV: the laboratory's curves, named columns")->required();
  command.add_option("SPEC", options->specification, "Specification (YAML): parameters, tests, targets")
      ->required();
  command.add_option("-o,--output", options->directory, "Folder to write [calibration]")->type_name("DIR");
  command
      .add_option("--packings", options->packings, "Folder that keeps the packings that are made [packings]")
      ->type_name("DIR");
  command.add_flag("--quiet", options->quiet, "No line for each evaluation");
  add_settings(command, options->settings);
  add_workers(command, options->workers, 1);
  add_trust(command, options->scripts, grains);
  return {&command, [options, &tools = grains.packing_tools] { return run_calibration(*options, tools); }};
}

}  // namespace polargrain::app
