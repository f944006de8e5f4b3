// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/run.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <optional>

#include "app/grains/cell_paths.hpp"
#include "app/remarks/status_of_run.hpp"
#include "app/run/advice.hpp"
#include "app/run/defaults_text.hpp"
#include "app/run/interrupt.hpp"
#include "app/run/missed_pulses.hpp"
#include "app/run/proof.hpp"
#include "app/run/quasi_static_record.hpp"
#include "app/run/result_directory.hpp"
#include "app/run/resume.hpp"
#include "app/run/run_checkpoints.hpp"
#include "app/run/run_files.hpp"
#include "app/run/run_log.hpp"
#include "app/run/run_observer.hpp"
#include "app/run/run_remarks.hpp"
#include "app/run/sample.hpp"
#include "app/run/soft_contacts.hpp"
#include "app/run/sources_elsewhere.hpp"
#include "app/run/start_text.hpp"
#include "app/run/take_step.hpp"
#include "common/error.hpp"
#include "common/prefixed_archive.hpp"
#include "common/seconds.hpp"
#include "common/standard_streams.hpp"
#include "common/stepping_note.hpp"
#include "coupler/cells/grains_of_points.hpp"
#include "coupler/pool/log_excerpt.hpp"
#include "coupler/pool/process.hpp"
#include "coupler/replay/replay.hpp"
#include "fem/solver/automatic.hpp"
#include "fem/solver/explicit_rate.hpp"
#include "fem/solver/stabilisation.hpp"
#include "fem/spread/spread_slip.hpp"

namespace polargrain::app {
namespace {

std::string going_on(int step, int steps) {
  return fmt::format("going on behind step {} of {}{}", step, steps, step < steps ? "" : ", the last");
}

/// One run in the plane or in space: its parts in the order they are made.
template <int dim>
class Run {
 public:
  /// @param from where to go on; null for a run from the start
  Run(const RunOptions& options, coupler::Case the_case, std::filesystem::path directory,
      const DirectoryLock& lock, std::optional<coupler::Listening> listening,
      std::unique_ptr<coupler::Checkpoint> from, Remarks remarks)
      : options_(options),
        lock_(lock),
        case_(std::move(the_case)),
        listening_(std::move(listening)),
        state_fault_(options.state_fault),
        directory_(std::move(directory)),
        from_(std::move(from)),
        resume_command_(resume_command(options, directory_)),
        checkpoints_(directory_, case_.steps(),
                     60.0 * options.checkpoint_minutes.value_or(case_.checkpoint_minutes)),
        log_("run", run_log_sink(directory_ / "run.log", !from_)),
        observer_(Progress::style_for(stderr, options.quiet), case_.steps(), log_),
        files_(case_, directory_, from_.get()),
        cell_paths_(case_, directory_, from_ ? from_->step : -1) {
    log_.flush_on(spdlog::level::info);
    log_.set_error_handler([](const std::string&) {});  // a full disk shows in the files that matter
    log_.info("polargrain {}: {} ({})", POLARGRAIN_VERSION, case_.title, case_.file.string());
    for (const std::string& setting : options.settings) log_.info("--set {}", setting);
    for (const std::string& line : lines_of_defaults(case_.left)) log_.info("{}", line);
    if (case_.needs_workers()) record_.workers = options.workers;
    record_.remarks = std::move(remarks);
    for (const Remark& remark : record_.remarks) log_.warn("remark: {}", line_of(remark));
    if (from_) go_on();
  }

  /// @returns whether the last step was committed
  bool go() {
    try {
      if (is_complete()) {
        log_.info("no step is left: the results stay as they are");
        record_.status = "done";
        return true;
      }
      start();  // also where no step is left: the summary asks the materials
      if (!steps()) return false;
      record_.status = "done";
    } catch (const Interrupted& error) {
      end_badly("stopped", error.what());
      throw Interrupted(record_.message);
    } catch (const FalseResults& error) {
      if (checkpoints_.forget())
        warn("the checkpoint of this run may hold false answers: it is checkpoint.doubtful.h5 now");
      end_badly("failed", error.what());
      throw RunError(record_.message);
    } catch (const std::exception& error) {
      end_badly("failed", error.what());
      throw RunError(record_.message);
    }
    finish();
    return true;
  }

  [[nodiscard]] const RunRecord& record() const { return record_; }
  [[nodiscard]] const coupler::Case& the_case() const { return case_; }

 private:
  /// Takes over what the checkpoint says about the steps taken.
  void go_on() {
    first_step_ = from_->step + 1;
    checkpoints_.begin_from(from_->step);
    for (CommittedStep& step : steps_of_history(from_->history, case_)) record_.add(std::move(step));
    PrefixedReader totals(from_->state, "run/");
    restore(totals, record_.costs, counts_before_);
    record_.pool = counts_before_;
    log_.info("{}", going_on(from_->step, case_.steps()));
    if (from_->program != POLARGRAIN_VERSION) {
      log_.warn("the checkpoint was written by version {}: the last bits of results may differ",
                from_->program);
    }
  }

  /// Whether a run that goes on has taken its last step, and has said all that it has to say.
  [[nodiscard]] bool is_complete() const {
    return first_step_ > case_.steps() && status_of_run(directory_) == "done";
  }

  void start() {
    if (case_.needs_workers()) {
      coupler::PoolOptions options;
      options.workers = record_.workers;
      options.directory = directory_;
      options.tell = [this](const std::string& text) {
        log_.warn(text);
        observer_.warn(text);
      };
      options.patience = case_.patience;
      options.check_share = case_.check_share;
      options.trust_scripts = options_.scripts.trusted;
      options.listening = std::move(listening_);
      options.state_fault = state_fault_;
      options.heed = [] { stop_if_interrupted(); };
      if (case_.check_share > 0.0 && options.workers == 1 && !options.listening)
        options.tell("workers: check: with one worker no evaluation can be checked by another one");
      pool_.emplace(options);
      note_interrupts();  // the library that sends messages may have changed the handling of signals
      pool_->on_answers([this](auto requests, auto replies) {
        sample_.take(requests, replies);
        cell_paths_.take(requests, replies);
      });
      pool_->on_progress([this](std::size_t done, std::size_t total) { observer_.cells(done, total); });
      log_.info("{} workers started, logs in {}", record_.workers, (directory_ / "logs").string());
      if (!pool_->listening_url().empty()) log_.info("workers may join at {}", pool_->listening_url());
    }
    for (auto& [region, material] : problem().materials) {
      // Every region has a material of its own: a fem::Material holds the states of one region's points.
      const coupler::MaterialRecipe& recipe = *case_.materials.at(case_.regions.at(region));
      material = recipe.make_for<dim>(pool_ ? &*pool_ : nullptr);
      if (const std::string note = recipe.note(); !note.empty()) warn(note);
    }
    if (case_.spread > 0.0) add_spread();
    solver_.emplace(problem(), case_.solver);
    solver_->set_observer(&observer_);
    observer_.on_struggle = [this](const fem::Trouble& trouble) {
      warn(fmt::format("this step has been cut twice: {}\n{}", trouble.reason, advice_on(trouble)));
    };
    if (!from_) return;
    PrefixedReader state(from_->state, "solver/");
    solver_->restore(state);
    observer_.go_on(solver_->state().time);
    checkpoints_.keep(std::move(from_));
    if (!record_.steps.empty() && first_step_ <= case_.steps()) files_.write(record_.steps.back(), *solver_);
  }

  /// Slips of cells are known no better than their stresses are balanced.
  void add_spread() {
    fem::SpreadOptions options{.width = case_.spread};
    if (case_.needs_workers()) options.tolerance = case_.solver.force_tolerance;
    fem::add_spread_slip<dim>(problem(), options);
    for (const std::string& place : case_.slips_held_on)
      for (const char* const field : fem::kSpreadFields)
        problem().prescribed_fields.push_back(
            {.field = field, .on = place, .value = fem::TimeTable::constant(0.0)});
  }

  /// @returns whether all steps were committed
  bool steps() {
    for (int step = first_step_; step <= case_.steps(); ++step) {
      stop_if_interrupted();
      observer_.begin_step(step);
      log_.info("step {}", step);
      step_ = step;
      const fem::StepReport report =
          step == 0 ? begin() : take(case_.plan[static_cast<std::size_t>(step) - 1]);
      log_step(log_, report, case_.solver.largest_strain);
      // The committed part of a step that was not reached is shown, but is no place to go on from.
      const bool partly = !report.converged && step > 0 && report.substeps > 0;
      CommittedStep committed{step, report, {}};
      if (report.converged || partly) {
        committed.values = monitor_values(case_.monitors, *solver_);
        files_.add(committed);
      }
      add_costs(step, report);
      if (report.converged) remember(step);
      if (const auto displaced = lock_.displacement()) throw RunError(displaced->text);
      if (report.converged || partly) {
        files_.write(committed, *solver_);
        keep_cell_paths(step);
        if (files_.has_fields(step) || partly) show_grains(step);
      }
      files_.write_rows();
      record_.add(std::move(committed));
      if (!report.converged) {
        end_badly("failed", fmt::format("step {} of {} did not converge: {}\n{}", step, case_.steps(),
                                        report.message, advice_on(solver_->trouble())));
        return false;
      }
      log_notes(step);
      if (!hot_ && report.quasi_static.hot_points > 0.0)
        hot_ = warn_if(
            fmt::format("{:.3g} % of the boxes do not come to rest in this step, their stress is one of "
                        "agitation too (hot_points in history.csv)",
                        100.0 * report.quasi_static.hot_points));
      if (!left_out_) left_out_ = warn_if(solver_->left_out());
      if (!doubt_) doubt_ = warn_if(fem::doubt_of_one_point_elements(*solver_));
      if (!soft_contacts_) soft_contacts_ = warn_if(soft_contacts(*solver_));
      if (solver_->has_lost_stability()) warn_of_instability("before", step);
      if (step == case_.steps() || checkpoints_.is_due()) save_or_warn();
      if (step == case_.steps() && !unstable_ && solver_->has_lost_stability_at_end())
        warn_of_instability("at the end of", step);
      observer_.end_step(report.time);
    }
    return true;
  }

  fem::StepReport begin() {
    if (!case_.start_from.empty()) return start_from(case_.start_from);
    if (case_.real_time) return solver_->begin_real_time(case_.explicit_options);
    if (case_.is_automatic()) return solver_->begin_automatic(case_.effort, case_.explicit_options);
    return case_.is_explicit() ? solver_->begin_explicit() : solver_->equilibrate();
  }

  /// Begins where another run has ended.
  fem::StepReport start_from(const std::filesystem::path& directory) {
    const std::filesystem::path file = directory / kCheckpointFile;
    coupler::Checkpoint end = coupler::read_checkpoint(file);
    log_.info("starting from step {} of {}", end.step, directory.string());
    try {
      PrefixedReader state(end.state, "solver/");
      const fem::StartReport start = solver_->start_from(state, coupler::regions_of(end.identity));
      log_.info("{}", text_of(start));
      if (start.outside > 0)
        warn(fmt::format(
            "{} points lie outside of their region in {}: they took the state of the nearest point, at "
            "most {:.3g} m away",
            start.outside, directory.string(), start.farthest));
      return start.step;
    } catch (const RunError& error) {
      throw RunError(fmt::format("{} cannot be started from: {}", file.string(), error.what()));
    }
  }

  fem::StepReport take(const coupler::StepTarget& target) {
    if (const coupler::CaseStage* const stage = case_.stage_of(step_); stage && stage->first_step == step_)
      log_.info("stage '{}'", stage->name);
    begin_stage_of(case_, step_, *solver_);
    doubt_tolerance();
    if (case_.real_time) return take_real_time(target.amount);
    if (target.explicit_steps == 0) return take_balanced_step(target, *solver_);
    return take_explicit(target);
  }

  fem::StepReport take_real_time(double time) {
    fem::StepReport report = solver_->advance_real_time(time, case_.explicit_options);
    if (step_ == 1 && report.explicit_steps > 0) {
      const std::string missed =
          missed_pulses(problem(), time / report.explicit_steps, case_.plan.back().amount);
      if (!missed.empty()) warn(missed);
    }
    return report;
  }

  /// Once a stage: the tolerance is a share of all loads and reactions, and little may change of them.
  void doubt_tolerance() {
    const coupler::CaseStage* const stage = case_.stage_of(step_);
    if (step_ != (stage ? stage->first_step : 1) || case_.real_time || case_.is_explicit()) return;
    constexpr double kLoose = 0.02;
    const double share = solver_->tolerated_share_of_change();
    if (!(share > kLoose)) return;
    const double tolerance = case_.solver.force_tolerance;
    warn(fmt::format(
        "'tolerance: {:.3g}' is a share of all loads and reactions and may leave {:.2g} % of the forces that change{} "
        "unbalanced, and a collapse unseen: write 'tolerance: {:.1g}'",
        tolerance, 100.0 * share, stage ? fmt::format(" in stage '{}'", stage->name) : "",
        tolerance * 0.1 * kLoose / share));
  }

  /// By explicit steps, or (automatic) by whichever method is due.
  fem::StepReport take_explicit(const coupler::StepTarget& target) {
    fem::ExplicitOptions options = case_.explicit_options;
    if (!files_.has_fields(step_)) options.rest = 0.0;
    const double before = record_.steps.empty() ? 1.0 : record_.steps.back().report.speed;
    const double speed = case_.rate_follows ? speed_behind(record_) : 1.0;
    options.speed_before = before / speed;
    if (speed != before) log_.info("  speed of the explicit steps {:.3g} of that at the start", speed);
    const auto steps = static_cast<int>(std::ceil(target.explicit_steps / speed));
    fem::StepReport report;
    if (case_.is_automatic()) {
      std::vector<fem::StepReport> reports;
      for (const CommittedStep& step : record_.steps) reports.push_back(step.report);
      report = fem::advance_automatic(*solver_, target.amount, reports, {case_.effort, steps, options});
    } else {
      report = solver_->advance_explicit(target.amount, steps, options);
    }
    report.speed = speed;
    return report;
  }

  /// The speed of explicit steps after those of the record.
  [[nodiscard]] double speed_behind(const RunRecord& record) const {
    if (record.steps.empty()) return 1.0;
    fem::ExplicitRate rate;
    rate.error = case_.explicit_error;
    return rate.next_speed(record.steps.back().report, solver_->steps_of_wave());
  }

  /// The costs of the cells since the start of the run, before the checkpoint included.
  [[nodiscard]] coupler::PoolCounts counts() const {
    return pool_ ? counts_before_ + pool_->counts() : counts_before_;
  }

  void add_costs(int step, const fem::StepReport& report) {
    const coupler::PoolCounts before = record_.pool;
    const Costs costs = add_lap(report);
    files_.add(step, costs, record_.pool - before);
  }

  /// The costs since the last call, cells that no step came of included, so that seconds and cells of the
  /// summary tell of the same work. From the end of the step before: output and checkpoints are in it.
  Costs add_lap(const fem::StepReport& report) {
    const coupler::PoolCounts before = record_.pool;
    record_.pool = counts();
    const double total = seconds_since(lap_);
    lap_ = Clock::now();
    const Costs costs =
        costs_between(before, record_.pool, std::max(1, record_.workers), total,
                      report.assembly_seconds + report.solve_seconds, report.material_seconds);
    record_.costs += costs;
    return costs;
  }

  /// Keeps the run as it is after a step, so that it can be written whenever it has to stop.
  void remember(int step) {
    auto checkpoint = std::make_unique<coupler::Checkpoint>();
    checkpoint->program = POLARGRAIN_VERSION;
    checkpoint->identity = case_.identity;
    checkpoint->step = step;
    checkpoint->history = files_.history();
    checkpoint->costs = files_.costs();
    PrefixedWriter totals(checkpoint->state, "run/");
    save(totals, record_.costs, record_.pool);
    PrefixedWriter state(checkpoint->state, "solver/");
    try {
      // Of the last step too: another run may start from it.
      solver_->save(state);
      checkpoints_.keep(std::move(checkpoint));
    } catch (const RunError& error) {
      if (step == 0) warn(fmt::format("this run cannot be interrupted without loss: {}", error.what()));
    }
  }

  /// So that the grains of any point can be looked at later. A run is worth more than that.
  void keep_cell_paths(int step) {
    if (cell_paths_failed_) return;
    try {
      cell_paths_.write(step, *solver_, case_.output_grains);
    } catch (const RunError& error) {
      cell_paths_failed_ = true;
      warn(fmt::format("grains of this step and later ones cannot be shown: {}", error.what()));
    }
  }

  /// Writes the grains that the case asks for, as `polargrain grains` does: in a process of its own, which has an engine.
  void show_grains(int step) {
    if (case_.output_grains.empty() || cell_paths_failed_ || grains_failed_) return;
    std::vector<std::string> command{std::filesystem::read_symlink("/proc/self/exe").string(),
                                     "grains",
                                     directory_.string(),
                                     "--quiet",
                                     "--step",
                                     std::to_string(step)};
    for (const std::size_t point : case_.output_grains)
      command.insert(command.end(), {"--point", std::to_string(point)});
    if (options_.scripts.trusted) command.emplace_back("--trust-scripts");
    const std::filesystem::path log = directory_ / "logs" / "grains.log";
    coupler::Process process(command, log, coupler::Process::Network::none);
    std::optional<std::string> end;
    while (!(end = process.end())) {
      stop_if_interrupted();
      pollfd ended{process.end_descriptor(), POLLIN, 0};
      poll(&ended, 1, 200);
    }
    if (*end == "exit status 0") return;
    grains_failed_ = true;
    warn(fmt::format("the grains of output: {{grains: ...}} are not shown from here on ({}):\n{}", *end,
                     coupler::log_excerpt(log)));
  }

  [[nodiscard]] fem::Problem<dim>& problem() { return case_.template problem_of<dim>(); }

  [[nodiscard]] std::string advice_on(const fem::Trouble& trouble) const {
    return step_ == 0 ? advice_at_start(trouble, *solver_, record_.remarks)
                      : advice(trouble, *solver_, case_);
  }

  void warn(const std::string& text) {
    log_.warn("  {}", text);
    observer_.warn(text);
  }

  void save_last() {
    if (const auto seconds = checkpoints_.save())
      log_.info("  checkpoint of step {} written in {:.3f} s", checkpoints_.saved_step(), *seconds);
  }

  /// A run that computes is worth more than a checkpoint that fails: it goes on and tries again later.
  void save_or_warn() {
    try {
      save_last();
    } catch (const RunError& error) {
      checkpoints_.postpone();
      warn(fmt::format("{}; {}; the run goes on", error.what(), checkpoints_.text()));
    }
  }

  void log_notes(int step) {
    for (const auto& contribution : problem().contributions)
      for (const std::string& note : contribution->take_notes()) log_.warn("  {}", note);
    for (auto& [region, material] : problem().materials) {
      for (const std::string& note : material->take_notes()) {
        if (note.starts_with(kSteppingNote)) {
          log_.info("  region '{}': {}", region, note);
          continue;
        }
        observer_.note(fmt::format("step {}, region '{}': {}", step, region, note));
        log_.warn("  region '{}': {}", region, note);
      }
    }
  }

  /// Once a run. @param when of the step: "before"
  void warn_of_instability(const char* when, int step) {
    if (unstable_) return;
    unstable_ = true;
    warn(fmt::format(
        "the balance {} step {} is unstable or has passed a bifurcation, as when a column buckles or a band forms: the run "
        "follows the even path beyond it. Look at shorter steps, and give the body a small imperfection or side load",
        when, step));
  }

  /// Warns when there is something to say; returns whether there was.
  bool warn_if(const std::string& text) {
    if (!text.empty()) warn(text);
    return !text.empty();
  }

  /// @returns a sentence for the user
  std::string write_replay_of(const coupler::CellFailure& failure) {
    const std::filesystem::path replay = directory_ / "replay";
    try {
      coupler::write_replay(replay, pool_->definition(failure.definition), failure.request, failure.reason);
    } catch (const std::exception& error) {
      return fmt::format("\nthe replay of the cell that failed could not be written: {}", error.what());
    }
    return fmt::format("\nthe cell that failed can be run alone: see {}", (replay / "README.md").string());
  }

  /// When the directory has gone, what can be saved goes where it is now, or to a new one.
  void follow_directory() {
    const auto displaced = lock_.displacement();
    if (!displaced) return;
    // A file that could not be written meanwhile is what comes of it.
    if (record_.message != displaced->text)
      record_.message = fmt::format("{} ({})", displaced->text, record_.message);
    try {
      directory_ = displaced->now.empty() ? make_rescue_directory(directory_) : displaced->now;
    } catch (const RunError& error) {
      record_.message += fmt::format("; {}", error.what());
    }
    checkpoints_.follow(directory_, !displaced->now.empty());
    resume_command_ = resume_command(options_, directory_);
  }

  /// Ends a run that has not reached its end. Nothing in here throws: the reason why it ends must be told.
  void end_badly(const std::string& status, const std::string& message) {
    observer_.clear();
    record_.status = status;
    record_.message = message;
    follow_directory();
    if (status == "failed" && pool_ && pool_->last_failure()) {
      record_.message += write_replay_of(*pool_->last_failure());
    }
    try {
      save_last();
    } catch (const std::exception& error) {
      record_.message += fmt::format("\n{}", error.what());
    }
    record_.message += fmt::format("\ncheckpoint: {}", checkpoints_.text());
    if (checkpoints_.saved_step() >= 0) record_.message += fmt::format("; to go on:\n  {}", resume_command_);
    log_.error("{}", record_.message);
    try {
      finish();
    } catch (const std::exception& error) {
      record_.message += fmt::format("\n{}", error.what());
    }
  }

  /// For polargrain verify. Without it the result is what it is.
  void save_sample() {
    try {
      write_sample(directory_ / kSampleFile, case_.identity, sample_.answers());
    } catch (const RunError& error) {
      warn(fmt::format("this result cannot be verified: {}", error.what()));
    }
  }

  /// @param grains null: the material has no cells
  void note_limits(const std::string& region, const coupler::GrainsOfPoints* grains) {
    const std::string limits = grains == nullptr ? "" : grains->at_limits();
    if (limits.empty()) return;
    log_.warn("  region '{}': {}", region, limits);
    record_.limits[region] = limits;
  }

  void finish() {
    add_lap({});
    for (const auto& [region, material] : problem().materials) {
      if (material == nullptr) continue;
      if (auto figures = material->figures(); !figures.empty()) record_.figures[region] = std::move(figures);
      note_limits(region, dynamic_cast<const coupler::GrainsOfPoints*>(material.get()));
      if (std::string doubt = material->doubt(); !doubt.empty()) {
        warn(fmt::format("region '{}': {}", region, doubt));
        record_.doubts[region] = std::move(doubt);
      }
    }
    for (const std::string& remark : quasi_static_remarks(case_, record_)) warn(remark);
    if (pool_) record_.worker_records = pool_->worker_records();
    log_.info("{}", record_.status);
    save_sample();
    record_.settings = options_.settings;
    // Behind the last line of the log, which is among them.
    record_.results = names_of_results(directory_);
    write_summary(directory_ / "summary.json", case_, record_);
  }

  const RunOptions& options_;
  const DirectoryLock& lock_;
  Clock::time_point lap_ = Clock::now();  ///< end of the step before
  coupler::Case case_;
  std::optional<coupler::Listening> listening_;
  StateCheck state_fault_;
  std::filesystem::path directory_;
  std::unique_ptr<coupler::Checkpoint> from_;
  std::string resume_command_;
  RunCheckpoints checkpoints_;
  spdlog::logger log_;
  RunObserver observer_;
  RunFiles files_;
  CellPathsRecord cell_paths_;
  bool cell_paths_failed_ = false;
  bool grains_failed_ = false;
  RunRecord record_;
  int first_step_ = 0;
  int step_ = 0;                       ///< that is taken now
  bool hot_ = false;                   ///< it was said that boxes do not come to rest
  bool left_out_ = false;              ///< it was said what small deformation leaves out
  bool doubt_ = false;                 ///< it was said that one-point elements are too soft
  bool soft_contacts_ = false;         ///< it was said that contacts are soft for the stress
  bool unstable_ = false;              ///< it was said that the balance is unstable
  coupler::PoolCounts counts_before_;  ///< before the checkpoint this run has gone on from
  std::optional<coupler::Pool> pool_;
  std::optional<fem::Solver<dim>> solver_;
  Sample sample_;
};

/// Takes all steps and tells of their end. @returns as run
template <int dim>
int go(const RunOptions& options, coupler::Case the_case, const std::filesystem::path& directory,
       const DirectoryLock& lock, std::optional<coupler::Listening> listening,
       std::unique_ptr<coupler::Checkpoint> from, Remarks remarks) {
  Run<dim> the_run(options, std::move(the_case), directory, lock, std::move(listening), std::move(from),
                   std::move(remarks));
  const bool done = the_run.go();
  const RunRecord& record = the_run.record();
  if (!options.quiet) {
    tell(stdout, "\n{}\n{}{}results: {} (history.csv, fields.pvd, summary.json, run.log)\n",
         table_text(the_run.the_case(), record), costs_text(record), figures_text(record),
         directory.string());
  }
  if (!done) tell(stderr, "error: {}\nlog: {}\n", record.message, (directory / "run.log").string());
  return done ? 0 : 1;
}

}  // namespace

int run(const RunOptions& options) {
  note_interrupts();  // first of all: from here on nobody is ended without a word
  const std::filesystem::path directory =
      options.directory.empty() ? default_result_directory(options.case_file) : options.directory;
  const FormerRun known = former_run_in(directory);
  coupler::Case the_case = coupler::read_case(options.case_file, options.settings, options.scripts);
  if (options.workers < 1 && options.listen.empty() && the_case.needs_workers()) {
    throw InputError(
        {"", 0, "--workers 0: the case needs workers; give at least 1, or --listen for others to come"});
  }
  std::optional<coupler::Listening> listening;
  if (!options.listen.empty()) coupler::check_tcp_url("--listen", options.listen);
  if (!options.listen.empty())
    listening = coupler::Listening{options.listen, coupler::read_coordinator_keys(options.keys)};
  stop_if_interrupted("before anything was written");
  Remarks remarks = remarks_before(options, the_case);
  check_sources_are_elsewhere(options, the_case, directory);
  stop_if_interrupted("before anything was written");
  const auto lock = prepare_result_directory(directory, options.resume, known);
  std::unique_ptr<coupler::Checkpoint> from;
  if (options.resume) from = checkpoint_for(the_case, directory / kCheckpointFile);
  stop_if_interrupted("before its first step");
  if (!options.quiet) {
    tell(stdout, "{}\n", the_case.title);
    if (from) tell(stdout, "{}\n", going_on(from->step, the_case.steps()));
  }
  if (!options.quiet && !remarks.empty()) tell(stderr, "{}", text_of(remarks));
  return the_case.dimension() == 3 ? go<3>(options, std::move(the_case), directory, *lock,
                                           std::move(listening), std::move(from), std::move(remarks))
                                   : go<2>(options, std::move(the_case), directory, *lock,
                                           std::move(listening), std::move(from), std::move(remarks));
}

}  // namespace polargrain::app
