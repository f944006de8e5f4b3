// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/summary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/run/automatic_record.hpp"
#include "app/run/energy_record.hpp"
#include "app/run/json_text.hpp"
#include "app/run/monitor_notes.hpp"
#include "app/run/proof.hpp"
#include "app/run/quasi_static_record.hpp"
#include "app/run/run_remarks.hpp"
#include "common/error.hpp"
#include "common/processor.hpp"
#include "fem/output/write_file.hpp"

namespace polargrain::app {
namespace {

/// An object whose members stay in the order in which they are written.
using Json = nlohmann::ordered_json;

Json error_figures(const RunRecord& record) {
  double force = 0.0;
  double moment = 0.0;
  for (const CommittedStep& step : record.steps) {
    force = std::max(force, step.report.force_residual);
    moment = std::max(moment, step.report.moment_residual);
  }
  Json errors{{"largest_force_residual", force}, {"largest_moment_residual", moment}};
  if (!record.steps.empty()) {
    const MonitorValues& last = record.steps.back().values;
    errors["external_minus_internal_work"] =
        value_of(last, "external_work") - value_of(last, "internal_work");
  }
  return errors;
}

Json cost_figures(const Costs& c) {
  return {{"total", c.total},
          {"grains", c.grains},
          {"messages", c.messages},
          {"waiting", c.waiting},
          {"finite_elements", c.finite_elements},
          {"rest", c.rest}};
}

Json cell_figures(const coupler::PoolCounts& pool) {
  return {{"evaluations", pool.evaluations},
          {"dem_steps", pool.dem_steps},
          {"engine_seconds", pool.engine_seconds},
          {"states_sent", pool.states_sent},
          {"states_fetched", pool.states_fetched},
          {"evaluations_again", pool.evaluations_again},
          {"evaluations_checked", pool.evaluations_checked},
          {"bytes_sent", pool.bytes_sent},
          {"bytes_received", pool.bytes_received}};
}

Json material_figures(const RunRecord& record) {
  Json regions = Json::object();
  for (const auto& [region, figures] : record.figures) {
    Json& material = regions[region] = Json::object();
    for (const fem::Figure& figure : figures) material[figure.name] = figure.value;
  }
  return regions;
}

/// The origin of the result, its makers, and its hashes.
Json proof_figures(const coupler::Case& the_case, const RunRecord& record) {
  Json workers = Json::object();
  for (const auto& [worker, done] : record.worker_records)
    workers[worker] = {{"evaluations", done.evaluations}, {"processor", done.processor}};
  return {{"processor", processor_model()}, {"case_file", name_of_file(the_case.file)},
          {"settings", record.settings},    {"files", the_case.identity.files},
          {"results", record.results},      {"workers", workers}};
}

Json last_values(const RunRecord& record) {
  Json values = Json::object();
  if (!record.steps.empty()) {
    for (const auto& [name, value] : record.steps.back().values) values[name] = value;
  }
  return values;
}

/// Names and steps of the stages of construction.
Json stage_figures(const coupler::Case& the_case) {
  Json stages = Json::array();
  for (const coupler::CaseStage& stage : the_case.stages)
    stages.push_back(
        {{"name", stage.name}, {"first_step", stage.first_step}, {"last_step", stage.last_step}});
  return stages;
}

}  // namespace

void RunRecord::add(CommittedStep step) {
  work += step.report;
  if (!step.values.empty()) steps.push_back(std::move(step));
}

void write_summary(const std::filesystem::path& file, const coupler::Case& the_case,
                   const RunRecord& record) {
  Json summary{{"program", "polargrain " POLARGRAIN_VERSION},
               {"case", the_case.file.string()},
               {"title", the_case.title},
               {"status", record.status},
               {"message", record.message},
               {"remarks", remarks_for_summary(record.remarks)},
               {"not_vouched_for", record.doubts},
               {"at_limits", record.limits},
               {"steps_asked", the_case.steps()},
               {"steps_committed", record.steps.empty() ? 0 : record.steps.back().step},
               {"iterations", record.work.iterations},
               {"cuts", record.work.cuts},
               {"substeps_within_noise", record.work.within_noise},
               {"substeps_within_rounding", record.work.within_rounding},
               {"corrections_limited", record.work.limited},
               {"jumps_passed", record.work.jumps},
               {"largest_jump_residual", record.work.jump_residual},
               {"point_evaluations", record.work.evaluations},
               {"workers", record.workers},
               {"values", last_values(record)},
               {"monitors", monitor_notes(the_case)},
               {"errors", error_figures(record)},
               {"seconds", cost_figures(record.costs)},
               {"cells", cell_figures(record.pool)},
               {"materials", material_figures(record)},
               {"proof", proof_figures(the_case, record)}};
  if (the_case.dimension() == 3) summary["dimension"] = 3;
  if (!the_case.stages.empty()) summary["stages"] = stage_figures(the_case);
  if (the_case.is_automatic()) summary["automatic"] = automatic_figures(record);
  if (the_case.real_time) summary["energies"] = energy_figures(record);
  if (the_case.is_explicit() && !the_case.real_time)
    summary["quasi_static"] = quasi_static_figures(the_case, record);
  // Of all that stands above, whatever it is: a key that is added is under the proof.
  summary["proof"]["summary"] = name_of_summary(summary);
  fem::write_file(file, json_text(summary));
}

namespace {

std::string stage_text(const coupler::Case& the_case, int step) {
  const coupler::CaseStage* const stage = the_case.stage_of(step);
  return stage == nullptr ? "" : "  " + stage->name;
}

}  // namespace

std::string table_text(const coupler::Case& the_case, const RunRecord& record) {
  constexpr std::size_t kMostRows = 20;
  std::string text = fmt::format("{:>6}", "step");
  for (const std::string& name : the_case.table) text += fmt::format("  {:>15}", name);
  const bool is_explicit = the_case.is_explicit();
  const bool iterates = !is_explicit || the_case.is_automatic();
  if (iterates) text += fmt::format("  {:>17}", "Newton iterations");
  if (is_explicit)
    text += fmt::format("  {:>15}  {:>15}", "explicit steps",
                        the_case.real_time ? "energy error" : "error estimate");
  if (!the_case.stages.empty()) text += "  stage";
  text += '\n';
  const std::size_t count = record.steps.size();
  const std::size_t stride = std::max<std::size_t>(1, (count + kMostRows - 1) / kMostRows);
  for (std::size_t s = 0; s < count; ++s) {
    if ((count - 1 - s) % stride != 0 && s != 0) continue;
    const CommittedStep& step = record.steps[s];
    text += fmt::format("{:>6}", step.step);
    for (const std::string& name : the_case.table)
      text += fmt::format("  {:>15.6g}", value_of(step.values, name));
    if (iterates) text += fmt::format("  {:>17}", step.report.iterations - step.report.explicit_steps);
    if (is_explicit)
      text += fmt::format(
          "  {:>15}  {:>13.2g} %", step.report.explicit_steps,
          100.0 * (the_case.real_time ? step.report.energies.error() : step.report.quasi_static.error()));
    text += stage_text(the_case, step.step) + '\n';
  }
  if (record.work.within_noise > 0) {
    text += fmt::format("{} substeps were accepted above the tolerance, within the noise of the stresses\n",
                        record.work.within_noise);
  }
  if (record.work.within_rounding > 0) {
    text += fmt::format("{} substeps were accepted above the tolerance, where only rounding is left\n",
                        record.work.within_rounding);
  }
  if (record.work.limited > 0) {
    text += fmt::format("{} corrections asked for too large a strain and were shortened or replaced\n",
                        record.work.limited);
  }
  if (record.work.jumps > 0) {
    text += fmt::format(
        "{} jumps of the stresses were passed; the largest left {:.3g} of the forces out of balance, let go "
        "by the end of its step\n",
        record.work.jumps, record.work.jump_residual);
  }
  if (the_case.real_time) text += energy_text(record);
  text += automatic_text(the_case, record) + quasi_static_text(the_case, record);
  return text;
}

std::string costs_text(const RunRecord& record) {
  const Costs& c = record.costs;
  std::string text = fmt::format("time spent (s, {:.1f} in all)\n", c.total);
  const auto part = [&](const char* name, double seconds) {
    text += fmt::format("  {:<34}{:>9.2f}  {:>5.1f} %\n", name, seconds, 100.0 * seconds / c.total);
  };
  if (record.pool.evaluations > 0) {
    part("grains", c.grains);
    part("messages", c.messages);
    part("workers waiting for the last cell", c.waiting);
  }
  part("finite elements", c.finite_elements);
  part("output and start", c.rest);
  if (record.pool.evaluations > 0) {
    const auto evaluations = static_cast<double>(record.pool.evaluations);
    text += fmt::format("cells: {} evaluations on {} workers, {:.4f} s and {:.0f} DEM steps each\n",
                        record.pool.evaluations, record.workers, record.pool.engine_seconds / evaluations,
                        static_cast<double>(record.pool.dem_steps) / evaluations);
    if (record.pool.evaluations_checked > 0)
      text += fmt::format("       {} of them were made by two workers, with the same bits\n",
                          record.pool.evaluations_checked);
  }
  return text;
}

std::string figures_text(const RunRecord& record) {
  std::string text;
  for (const auto& [region, figures] : record.figures) {
    text += fmt::format("material of region '{}'\n", region);
    for (const fem::Figure& figure : figures)
      text += fmt::format("  {:<34}{:>9.4g}\n", figure.name, figure.value);
  }
  for (const auto& [region, limits] : record.limits) text += fmt::format("region '{}': {}\n", region, limits);
  for (const auto& [region, doubt] : record.doubts) text += fmt::format("region '{}': {}\n", region, doubt);
  return text;
}

}  // namespace polargrain::app
