// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/commands/run.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cstdio>
#include <optional>

#include "common/error.hpp"
#include "coupler/case/case.hpp"
#include "coupler/commands/csv_file.hpp"
#include "coupler/commands/interrupt.hpp"
#include "coupler/commands/progress.hpp"
#include "coupler/commands/result_directory.hpp"
#include "coupler/commands/summary.hpp"
#include "coupler/replay/replay.hpp"
#include "fem/output/vtu.hpp"

namespace polargrain::coupler {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Progress for the user, and what happens for the log.
class RunObserver : public Progress {
 public:
  RunObserver(Style style, int steps, spdlog::logger& log) : Progress(stderr, style, steps), log_(log) {}
  void iterated(const fem::IterationReport& report) override {
    log_.info("  iteration {}: force residual {:.3e}, moment residual {:.3e}", report.iteration,
              report.force_residual, report.moment_residual);
    Progress::iterated(report);
  }
  void cut(double time, const std::string& reason, double next_time) override {
    log_.warn("  step to {:.6g} given up: {}; next try to {:.6g}", time, reason, next_time);
  }

 private:
  spdlog::logger& log_;
};

/// One run: its parts in the order they are made.
class Run {
 public:
  Run(const RunOptions& options, Case the_case, std::filesystem::path directory,
      std::optional<Listening> listening)
      : case_(std::move(the_case)),
        listening_(std::move(listening)),
        directory_(std::move(directory)),
        log_("run",
             std::make_shared<spdlog::sinks::basic_file_sink_mt>((directory_ / "run.log").string(), true)),
        observer_(Progress::style_for(stderr, options.quiet), case_.steps(), log_),
        history_(directory_ / "history.csv", history_columns()),
        costs_file_(directory_ / "costs.csv",
                    {"step", "total", "grains", "messages", "waiting", "finite_elements", "rest",
                     "cell_evaluations", "dem_steps", "bytes_sent", "bytes_received"}),
        collection_(directory_ / "fields.pvd") {
    log_.flush_on(spdlog::level::info);
    log_.info("polargrain {}: {} ({})", POLARGRAIN_VERSION, case_.title, case_.file.string());
    for (const std::string& setting : options.settings) log_.info("--set {}", setting);
    if (case_.needs_workers()) record_.workers = options.workers;
  }

  /// @returns whether the last step was committed
  bool go() {
    try {
      start();
      if (!steps()) return false;
      record_.status = "done";
    } catch (const std::exception& error) {
      end_badly(error.what());
      throw;
    }
    finish();
    return true;
  }

  [[nodiscard]] const RunRecord& record() const { return record_; }
  [[nodiscard]] const Case& the_case() const { return case_; }

 private:
  void start() {
    if (case_.needs_workers()) {
      PoolOptions options;
      options.workers = record_.workers;
      options.directory = directory_;
      options.tell = [this](const std::string& text) {
        log_.warn(text);
        observer_.warn(text);
      };
      options.patience = case_.patience;
      options.listening = std::move(listening_);
      pool_.emplace(options);
      pool_->on_progress([this](std::size_t done, std::size_t total) { observer_.cells(done, total); });
      log_.info("{} workers started, logs in {}", record_.workers, (directory_ / "logs").string());
      if (!pool_->listening_url().empty()) log_.info("workers may join at {}", pool_->listening_url());
    }
    for (auto& [region, material] : case_.problem.materials) {
      // Every region has a material of its own: a fem::Material holds the states of one region's points.
      material = case_.materials.at(case_.regions.at(region))->make(pool_ ? &*pool_ : nullptr);
    }
    solver_.emplace(case_.problem, case_.solver);
    solver_->set_observer(&observer_);
  }

  /// @returns whether all steps were committed
  bool steps() {
    for (int step = 0; step <= case_.steps(); ++step) {
      const PoolCounts before = pool_ ? pool_->counts() : PoolCounts{};
      const Clock::time_point begin = step == 0 ? begin_ : Clock::now();
      observer_.begin_step(step);
      log_.info("step {}", step);
      const fem::StepReport report =
          step == 0 ? solver_->equilibrate() : take(case_.plan[static_cast<std::size_t>(step) - 1]);
      count(report);
      if (report.converged || (step > 0 && report.substeps > 0)) write_step(step, report);
      write_costs(step, report, before, seconds_since(begin));
      if (!report.converged) {
        end_badly(fmt::format("step {} of {} did not converge: {}", step, case_.steps(), report.message));
        return false;
      }
      log_notes();
      observer_.end_step(report.time);
    }
    return true;
  }

  fem::StepReport take(const StepTarget& target) {
    switch (target.control) {
      case StepTarget::Control::measure:
        return solver_->advance_measure(target.measure, target.amount);
      case StepTarget::Control::arc_length:
        return solver_->advance_arc_length(target.amount);
      case StepTarget::Control::time:
        break;
    }
    return solver_->advance(target.amount);
  }

  void count(const fem::StepReport& report) {
    record_.iterations += report.iterations;
    record_.cuts += report.cuts;
    record_.evaluations += report.evaluations;
    record_.within_noise += report.within_noise;
    record_.within_rounding += report.within_rounding;
    record_.limited += report.limited;
    if (report.within_noise > 0) {
      log_.warn(
          "  accepted above the tolerance, within the noise of the stresses: force residual {:.3e}, noise "
          "{:.3e}",
          report.force_residual, report.force_noise);
    }
    if (report.within_rounding > 0) {
      log_.warn("  accepted above the tolerance because nothing but rounding is left: force residual {:.3e}",
                report.force_residual);
    }
    if (report.limited > 0) {
      log_.warn("  {} corrections asked for strains beyond {} and were shortened or replaced", report.limited,
                case_.solver.largest_strain);
    }
    log_.info("  {} after {} iterations, {} cuts, {} evaluations, time {:.6g}",
              report.converged ? "converged" : "NOT converged", report.iterations, report.cuts,
              report.evaluations, report.time);
  }

  [[nodiscard]] std::vector<std::string> history_columns() const {
    std::vector<std::string> columns{"step",        "time",         "substeps",        "cuts",
                                     "iterations",  "evaluations",  "force_residual",  "moment_residual",
                                     "force_noise", "within_noise", "within_rounding", "limited"};
    for (const std::string& name : built_in_values()) {
      if (name != "time") columns.push_back(name);
    }
    for (const Monitor& monitor : case_.monitors) columns.push_back(monitor.name);
    return columns;
  }

  void write_step(int step, const fem::StepReport& report) {
    const MonitorValues values = monitor_values(case_.monitors, *solver_);
    std::vector<std::string> row{std::to_string(step),
                                 exact(report.time),
                                 std::to_string(report.substeps),
                                 std::to_string(report.cuts),
                                 std::to_string(report.iterations),
                                 std::to_string(report.evaluations),
                                 exact(report.force_residual),
                                 exact(report.moment_residual),
                                 exact(report.force_noise),
                                 std::to_string(report.within_noise),
                                 std::to_string(report.within_rounding),
                                 std::to_string(report.limited)};
    for (const auto& [name, value] : values) {
      if (name != "time") row.push_back(exact(value));
    }
    history_.row(row);
    record_.steps.push_back({step, report, values});
    if (step % case_.output_every == 0 || step == case_.steps() || !report.converged) write_fields(step);
  }

  void write_fields(int step) {
    const std::filesystem::path name = std::filesystem::path("fields") / fmt::format("step-{:05}.vtu", step);
    std::filesystem::create_directories(directory_ / "fields");
    fem::write_vtu(directory_ / name, case_.problem.mesh, fem::collect_fields(*solver_));
    collection_.add(solver_->state().time, name);
  }

  void write_costs(int step, const fem::StepReport& report, const PoolCounts& before, double total) {
    const PoolCounts after = pool_ ? pool_->counts() : PoolCounts{};
    const Costs costs =
        costs_between(before, after, std::max(1, record_.workers), total,
                      report.assembly_seconds + report.solve_seconds, report.material_seconds);
    record_.costs += costs;
    record_.pool = after;
    std::vector<std::string> row{std::to_string(step)};
    for (const double seconds :
         {costs.total, costs.grains, costs.messages, costs.waiting, costs.finite_elements, costs.rest}) {
      row.push_back(fmt::format("{:.6f}", seconds));
    }
    for (const std::int64_t whole :
         {after.evaluations - before.evaluations, after.dem_steps - before.dem_steps,
          after.bytes_sent - before.bytes_sent, after.bytes_received - before.bytes_received}) {
      row.push_back(std::to_string(whole));
    }
    costs_file_.row(row);
  }

  void log_notes() {
    for (auto& [region, material] : case_.problem.materials) {
      for (const std::string& note : material->take_notes()) {
        observer_.clear();
        fmt::print(stderr, "note: region '{}': {}\n", region, note);
        log_.warn("  region '{}': {}", region, note);
      }
    }
  }

  void end_badly(std::string message) {
    observer_.clear();
    if (pool_ && pool_->last_failure()) message += write_replay_of(*pool_->last_failure());
    record_.status = "failed";
    record_.message = message;
    log_.error("{}", message);
    finish();
  }

  /// @returns what to tell the user of it
  std::string write_replay_of(const CellFailure& failure) {
    const std::filesystem::path replay = directory_ / "replay";
    try {
      write_replay(replay, pool_->definition(failure.definition), failure.request,
                   fmt::format("Point {}: {}", failure.point, failure.reason));
    } catch (const std::exception& error) {
      return fmt::format("\nthe replay of the cell that failed could not be written: {}", error.what());
    }
    return fmt::format("\nthe cell that failed can be run alone: see {}", (replay / "README.md").string());
  }

  void finish() {
    if (pool_) record_.pool = pool_->counts();
    for (const auto& [region, material] : case_.problem.materials) {
      if (material == nullptr) continue;
      if (auto figures = material->figures(); !figures.empty()) record_.figures[region] = std::move(figures);
    }
    log_.info("{}", record_.status);
    write_summary(directory_ / "summary.json", case_, record_);
  }

  Clock::time_point begin_ = Clock::now();
  Case case_;
  std::optional<Listening> listening_;
  std::filesystem::path directory_;
  spdlog::logger log_;
  RunObserver observer_;
  CsvFile history_;
  CsvFile costs_file_;
  fem::PvdCollection collection_;
  RunRecord record_;
  std::optional<Pool> pool_;
  std::optional<fem::Solver> solver_;
};

}  // namespace

int run(const RunOptions& options) {
  Case the_case = read_case(options.case_file, options.settings);
  if (options.workers < 1 && options.listen.empty() && the_case.needs_workers()) {
    throw InputError(
        {"", 0, "--workers 0: the case needs workers; give at least 1, or --listen for others to come"});
  }
  std::optional<Listening> listening;
  if (!options.listen.empty()) listening = Listening{options.listen, read_coordinator_keys(options.keys)};
  const std::filesystem::path directory =
      options.directory.empty() ? default_result_directory(options.case_file) : options.directory;
  prepare_result_directory(directory);
  note_interrupts();
  if (!options.quiet) fmt::print("{}\n", the_case.title);
  std::fflush(stdout);
  Run the_run(options, std::move(the_case), directory, std::move(listening));
  const bool done = the_run.go();
  const RunRecord& record = the_run.record();
  if (!options.quiet) {
    fmt::print("\n{}\n{}{}results: {} (history.csv, fields.pvd, summary.json, run.log)\n",
               table_text(the_run.the_case(), record), costs_text(record), figures_text(record),
               directory.string());
  }
  if (!done) fmt::print(stderr, "error: {} (log: {})\n", record.message, (directory / "run.log").string());
  return done ? 0 : 1;
}

}  // namespace polargrain::coupler
