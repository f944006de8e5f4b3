// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/bench/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "app/bench/bench_band.hpp"
#include "app/bench/bench_page.hpp"
#include "app/page/page.hpp"
#include "app/run/interrupt.hpp"
#include "app/run/monitor_notes.hpp"
#include "app/run/progress.hpp"
#include "app/run/result_directory.hpp"
#include "app/run/run.hpp"
#include "common/csv_table.hpp"
#include "common/error.hpp"
#include "common/regular_file.hpp"
#include "common/seconds.hpp"
#include "common/standard_streams.hpp"
#include "coupler/case/case.hpp"
#include "fem/output/write_file.hpp"

namespace polargrain::app {
namespace {

BenchAxes axes_of(const BenchOptions& options, const coupler::Case& the_case) {
  BenchAxes axes{options.x, options.y, !options.band.empty()};
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
  const auto notes = monitor_notes(the_case);
  const auto unit_of = [&](const std::string& name) {
    return notes.contains(name) ? notes[name]["unit"].get<std::string>() : std::string();
  };
  axes.x_unit = unit_of(axes.x);
  for (const std::string& y : axes.y) axes.y_units.push_back(unit_of(y));
  return axes;
}

void check_axes(const BenchAxes& axes, const coupler::Case& the_case) {
  std::vector<std::string> known = coupler::built_in_values();
  for (const coupler::Monitor& monitor : the_case.monitors) known.push_back(monitor.name);
  std::vector<std::string> wanted = axes.y;
  wanted.push_back(axes.x);
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw InputError(
        {the_case.file.string(), 0,
         fmt::format("has no monitor '{}', which bench compares; it has {}", name, coupler::listed(known))});
  }
}

double sum(const CsvTable& table, const std::string& name) {
  const std::vector<double> values = table.numbers(name);
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Without the steps at which one of both is no number, as a ratio of forces is before there are any.
BenchCurve curve_of(const CsvTable& history, const std::string& x, const std::string& y) {
  BenchCurve curve;
  const std::size_t of_x = history.column(x);
  const std::size_t of_y = history.column(y);
  const std::size_t of_time = history.column("time");
  for (std::size_t row = 0; row < history.rows(); ++row) {
    const double at = history.figure(row, of_x);
    const double value = history.figure(row, of_y);
    if (!std::isfinite(at) || !std::isfinite(value)) continue;
    curve.x.push_back(at);
    curve.y.push_back(value);
    curve.time.push_back(history.number(row, of_time));
  }
  return curve;
}

BenchResult take(const BenchSetting& setting, const std::filesystem::path& directory,
                 const BenchOptions& options, const BenchAxes& axes) {
  BenchResult result{setting, "done", 0, 0.0, 0.0, 0.0, {}, {}, {}, {}, false};
  RunOptions run_options;
  run_options.case_file = setting.case_file;
  run_options.directory = directory;
  run_options.workers = options.workers;
  run_options.resume = options.resume && std::filesystem::exists(directory / kCheckpointFile);
  run_options.quiet = true;
  run_options.settings = setting.overrides;
  run_options.scripts = options.scripts;
  try {
    if (run(run_options) != 0)
      result.status = fmt::format("stopped; see {}", (directory / "run.log").string());
  } catch (const Interrupted&) {
    throw;
  } catch (const RunError& error) {
    result.status = error.what();
  }
  const CsvTable history(directory / "history.csv");
  const CsvTable costs(directory / "costs.csv");
  result.seconds = sum(costs, "total");
  result.evaluations = sum(costs, "cell_evaluations");
  result.dem_steps = sum(costs, "dem_steps");
  for (const std::string& y : axes.y) {
    result.steps = std::max(0, static_cast<int>(history.rows()) - 1);
    result.curves.push_back(curve_of(history, axes.x, y));
  }
  if (axes.band) result.band = bench_band(directory, axes.x, options.band.front(), options.band.back());
  return result;
}

/// The files of the folder have usual names, which those of others may have too. @throws InputError
void check_folder(const BenchOptions& options) {
  const std::string remedy = "name another folder with -o, or remove it";
  const std::filesystem::path table = options.directory / "bench.csv";
  const std::filesystem::path page = options.directory / "bench.html";
  if (const std::string reason = why_not_own(table, "case,what,", "table of bench"); !reason.empty())
    throw InputError({table.string(), 0, reason + "; " + remedy});
  if (const std::string reason = why_no_page(page, remedy); !reason.empty())
    throw InputError({page.string(), 0, reason});
}

/// The input read before anything runs, so that a typing error costs no hour.
struct Checked {
  std::string title;
  BenchAxes axes;
};

Checked check(const BenchOptions& options, const std::vector<BenchSetting>& settings) {
  if (!options.band.empty() && options.band.front() >= options.band.back())
    throw InputError({"--band", 0, "expected FROM,TO, axial strains of which the second is larger"});
  Checked checked;
  for (const BenchSetting& setting : settings) {
    if (setting.grains > 0) continue;  // its packing is not there yet, the rest is that of the case as given
    const coupler::Case the_case = coupler::read_case(setting.case_file, setting.overrides, options.scripts);
    if (checked.title.empty()) checked = {the_case.title, axes_of(options, the_case)};
    check_axes(checked.axes, the_case);
  }
  return checked;
}

/// All that is made of the results so far.
class Report {
 public:
  Report(const BenchOptions& options, Checked checked) : options_(options), checked_(std::move(checked)) {}

  void update(std::vector<BenchResult>& results) {
    compare(results);
    const std::vector<SizeScatter> sizes = compare_sizes(results);
    mark_front(results);
    table_ = bench_table(checked_.axes, results, sizes);
    reference_of_sizes_ = reference_of_sizes(sizes);
    write_csv(options_.directory / "bench.csv", table_);
    fem::write_file(options_.directory / "bench.html",
                    bench_page(checked_.title, checked_.axes, results, sizes, table_));
  }

  void print(const std::string& reference) const {
    tell(stdout, "{}\nreference: {}\n", markdown(table_), reference);
    if (!reference_of_sizes_.empty())
      tell(stdout, "reference of the packings of {}: {}\n", options_.pack.string(), reference_of_sizes_);
    tell(stdout, "results: {} (bench.csv, bench.html, and a folder for each run)\n",
         options_.directory.string());
  }

 private:
  const BenchOptions& options_;
  Checked checked_;
  BenchTable table_;
  std::string reference_of_sizes_;
};

void print_progress(const BenchSetting& setting, std::size_t done, std::size_t all, double spent) {
  const std::string left =
      done == 0
          ? ""
          : fmt::format(", about {} left",
                        duration_text(spent / static_cast<double>(done) * static_cast<double>(all - done)));
  tell(stderr, "run {} of {}: {}{}{}{}\n", done + 1, all, setting.group, setting.label.empty() ? "" : ", ",
       setting.label, left);
}

}  // namespace

int bench(const BenchOptions& options, const PackingTools& packing_tools) {
  const std::vector<BenchPacking> packings = bench_packings(options);
  const std::vector<BenchSetting> settings = bench_settings(options, packings);
  const Checked checked = check(options, settings);
  check_folder(options);
  std::filesystem::create_directories(options.directory);
  make_packings(options, packings, packing_tools);
  Report report(options, checked);
  std::vector<BenchResult> results;
  const Clock::time_point start = Clock::now();
  for (const BenchSetting& setting : settings) {
    if (!options.quiet) {
      const double spent = seconds_since(start);
      print_progress(setting, results.size(), settings.size(), spent);
    }
    const std::filesystem::path directory = options.directory / fmt::format("run-{:02}", results.size());
    try {
      stop_if_interrupted();
      results.push_back(take(setting, directory, options, checked.axes));
    } catch (const Interrupted& error) {
      throw Interrupted(
          fmt::format("{}\nthe whole bench goes on with the same command and --resume", error.what()));
    }
    report.update(results);
  }
  if (!options.quiet) report.print(results.front().setting.label);
  const auto done =
      std::count_if(results.begin(), results.end(), [](const BenchResult& r) { return r.done(); });
  return results.front().done() && done > 1 ? 0 : 1;
}

}  // namespace polargrain::app
