// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/commands/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <numeric>

#include "common/error.hpp"
#include "coupler/case/case.hpp"
#include "coupler/commands/bench_page.hpp"
#include "coupler/commands/csv_file.hpp"
#include "coupler/commands/interrupt.hpp"
#include "coupler/commands/progress.hpp"
#include "coupler/commands/run.hpp"

namespace polargrain::coupler {
namespace {

using Clock = std::chrono::steady_clock;

/// What is plotted against what.
struct Axes {
  std::string x;
  std::vector<std::string> y;
};

Axes axes_of(const BenchOptions& options, const Case& the_case) {
  Axes axes{options.x, options.y};
  if (axes.x.empty() && !the_case.table.empty()) axes.x = the_case.table.front();
  if (axes.y.empty() && the_case.table.size() > 1) {
    axes.y.assign(the_case.table.begin() + 1, the_case.table.end());
  }
  if (axes.x.empty() || axes.y.empty()) {
    throw InputError(
        {options.cases.front().string(), 0,
         "bench needs a monitor to go along and one to compare: list both under output: table, or "
         "name them with --x and --y"});
  }
  return axes;
}

void check_axes(const Axes& axes, const Case& the_case) {
  std::vector<std::string> known = built_in_values();
  for (const Monitor& monitor : the_case.monitors) known.push_back(monitor.name);
  std::vector<std::string> wanted = axes.y;
  wanted.push_back(axes.x);
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw InputError(
        {the_case.file.string(), 0,
         fmt::format("has no monitor '{}', which bench compares; it has {}", name, listed(known))});
  }
}

double sum(const std::map<std::string, std::vector<double>>& columns, const std::string& name) {
  const auto column = columns.find(name);
  return column == columns.end() ? 0.0 : std::accumulate(column->second.begin(), column->second.end(), 0.0);
}

BenchResult take(const BenchSetting& setting, const std::filesystem::path& directory,
                 const BenchOptions& options, const Axes& axes) {
  BenchResult result{setting, "done", 0, 0.0, 0.0, 0.0, {}, {}, false};
  RunOptions run_options;
  run_options.case_file = setting.case_file;
  run_options.directory = directory;
  run_options.workers = options.workers;
  run_options.quiet = true;
  run_options.settings = setting.overrides;
  try {
    if (run(run_options) != 0)
      result.status = fmt::format("stopped; see {}", (directory / "run.log").string());
  } catch (const RunError& error) {
    result.status = error.what();
  }
  const auto history = read_columns(directory / "history.csv");
  const auto costs = read_columns(directory / "costs.csv");
  result.seconds = sum(costs, "total");
  result.evaluations = sum(costs, "cell_evaluations");
  result.dem_steps = sum(costs, "dem_steps");
  for (const std::string& y : axes.y) {
    BenchCurve curve;
    if (history.count(axes.x) != 0) curve = {history.at(axes.x), history.at(y)};
    result.steps = std::max(0, static_cast<int>(curve.x.size()) - 1);
    result.curves.push_back(std::move(curve));
  }
  return result;
}

void write_results(const BenchOptions& options, const std::string& title, const Axes& axes,
                   const std::vector<BenchResult>& results) {
  std::vector<std::string> columns{"case",  "what",    "setting",          "status",
                                   "steps", "seconds", "cell_evaluations", "dem_steps"};
  for (const std::string& y : axes.y) {
    columns.push_back("error_" + y);
    columns.push_back("peak_error_" + y);
  }
  columns.push_back("front");
  CsvFile file(options.directory / "bench.csv", columns);
  const auto one_cell = [](std::string text) {
    std::replace(text.begin(), text.end(), ',', ';');
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
  };
  for (const BenchResult& result : results) {
    std::vector<std::string> row{one_cell(result.setting.case_file.string()),
                                 one_cell(result.setting.group),
                                 one_cell(result.setting.label),
                                 one_cell(result.status),
                                 std::to_string(result.steps),
                                 fmt::format("{:.3f}", result.seconds),
                                 fmt::format("{:.0f}", result.evaluations),
                                 fmt::format("{:.0f}", result.dem_steps)};
    for (const BenchError& error : result.errors) {
      row.push_back(exact(error.largest));
      row.push_back(exact(error.peak));
    }
    row.push_back(result.on_front ? "1" : "0");
    file.row(row);
  }
  std::ofstream page(options.directory / "bench.html", std::ios::trunc);
  page << bench_page(title, axes.x, axes.y, results) << std::flush;
  if (!page) throw RunError(fmt::format("{} cannot be written", (options.directory / "bench.html").string()));
}

}  // namespace

int bench(const BenchOptions& options) {
  const std::vector<BenchSetting> settings = bench_settings(options);
  // Everything is checked before anything runs, so that a typing error costs no hour.
  std::string title;
  Axes axes;
  for (const BenchSetting& setting : settings) {
    const Case the_case = read_case(setting.case_file, setting.overrides);
    if (title.empty()) {
      title = the_case.title;
      axes = axes_of(options, the_case);
    }
    check_axes(axes, the_case);
  }
  std::filesystem::create_directories(options.directory);
  std::vector<BenchResult> results;
  const Clock::time_point start = Clock::now();
  for (const BenchSetting& setting : settings) {
    stop_if_interrupted();
    const double spent = std::chrono::duration<double>(Clock::now() - start).count();
    if (!options.quiet) {
      const std::string left =
          results.empty() ? ""
                          : fmt::format(", about {} left",
                                        duration_text(spent / static_cast<double>(results.size()) *
                                                      static_cast<double>(settings.size() - results.size())));
      fmt::print(stderr, "run {} of {}: {}{}{}{}\n", results.size() + 1, settings.size(), setting.group,
                 setting.label.empty() ? "" : ", ", setting.label, left);
    }
    results.push_back(
        take(setting, options.directory / fmt::format("run-{:02}", results.size()), options, axes));
    compare(results);
    write_results(options, title, axes, results);
  }
  if (!options.quiet) {
    fmt::print("{}\nreference: {}\nresults: {} (bench.csv, bench.html, and a folder for each run)\n",
               bench_table(axes.y, results), results.front().setting.label, options.directory.string());
  }
  const auto done =
      std::count_if(results.begin(), results.end(), [](const BenchResult& r) { return r.done(); });
  return results.front().done() && done > 1 ? 0 : 1;
}

}  // namespace polargrain::coupler
