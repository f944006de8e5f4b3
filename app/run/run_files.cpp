// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/run_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "app/run/monitor_values.hpp"
#include "app/run/place_values.hpp"
#include "app/run/structure_files.hpp"
#include "common/cell.hpp"
#include "common/error.hpp"
#include "common/record_table.hpp"
#include "coupler/case/columns_of_steps.hpp"

namespace polargrain::app {
namespace {

/// Columns of the solver alone.
std::vector<std::string> columns_of_steps(const coupler::Case& the_case) {
  std::vector<std::string> columns = coupler::columns_of_steps();
  if (the_case.is_explicit())
    columns.insert(columns.end(), coupler::columns_of_explicit_steps().begin(),
                   coupler::columns_of_explicit_steps().end());
  if (the_case.is_automatic()) columns.emplace_back(coupler::kGivenUp);
  if (the_case.rate_follows) columns.emplace_back(coupler::kSpeed);
  if (the_case.real_time)
    columns.insert(columns.end(), coupler::columns_of_energies().begin(),
                   coupler::columns_of_energies().end());
  if (!the_case.stages.empty()) columns.emplace_back(coupler::kStageColumn);
  return columns;
}

std::vector<std::string> history_columns(const coupler::Case& the_case) {
  std::vector<std::string> columns = columns_of_steps(the_case);
  for (const std::string& name : coupler::built_in_values()) {
    if (name != "time") columns.push_back(name);
  }
  for (const coupler::Monitor& monitor : the_case.monitors) columns.push_back(monitor.name);
  return columns;
}

const std::vector<std::string> kCostColumns{
    "step",      "total",           "grains",        "messages",
    "waiting",   "finite_elements", "rest",          "cell_evaluations",
    "dem_steps", "bytes_sent",      "bytes_received"};

std::filesystem::path fields_file(int step) {
  return std::filesystem::path("fields") / fmt::format("step-{:05}.vtu", step);
}

/// Not step-...: that is what fields of elements are called.
std::filesystem::path points_file(int step) {
  return std::filesystem::path("fields") / fmt::format("points-{:05}.vtu", step);
}

std::filesystem::path profile_file(const std::string& name, int step) {
  return std::filesystem::path("profiles") / fmt::format("{}-{:05}.csv", name, step);
}

/// Gives what cells show the units that their record tells; other fields of materials are pure numbers.
void name_units(std::vector<fem::Field>& fields) {
  static const std::vector<Column> of_cells = columns_of<CellDiagnostics>();
  for (fem::Field& field : fields) {
    if (!field.unit.empty()) continue;
    const auto found = std::ranges::find(of_cells, field.name, &Column::name);
    field.unit = found == of_cells.end() ? "1" : found->unit;
  }
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

}  // namespace

RunFiles::RunFiles(const coupler::Case& the_case, std::filesystem::path directory,
                   const coupler::Checkpoint* from)
    : case_(the_case),
      directory_(std::move(directory)),
      history_(from == nullptr ? CsvFile(directory_ / "history.csv", history_columns(the_case))
                               : CsvFile(directory_ / "history.csv", from->history)),
      costs_(from == nullptr ? CsvFile(directory_ / "costs.csv", kCostColumns)
                             : CsvFile(directory_ / "costs.csv", from->costs)),
      collection_(directory_ / "fields.pvd"),
      points_collection_(directory_ / "points.pvd") {
  if (from != nullptr) go_on(*from);
}

void RunFiles::go_on(const coupler::Checkpoint& from) {
  for (const CommittedStep& step : steps_of_history(from.history, case_)) {
    // The fields of the checkpoint's own step may have been lost with the run: they are written once more.
    // Behind the last step nothing is left to be lost.
    if (has_fields(step.step) && (step.step < from.step || from.step == case_.steps())) {
      collection_.add(step.report.time, fields_file(step.step));
      if (case_.output_points) points_collection_.add(step.report.time, points_file(step.step));
    }
  }
  std::error_code error;
  for (int step = from.step; step <= case_.steps() && from.step < case_.steps(); ++step) {
    std::filesystem::remove(directory_ / fields_file(step), error);
    std::filesystem::remove(directory_ / points_file(step), error);
    for (const coupler::Profile& profile : case_.profiles)
      std::filesystem::remove(directory_ / profile_file(profile.name, step), error);
  }
}

bool RunFiles::has_fields(int step) const {
  return step % case_.output_every == 0 || step == case_.steps();
}

void RunFiles::add(const CommittedStep& step) {
  const fem::StepReport& report = step.report;
  std::vector<std::string> row{std::to_string(step.step),
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
                               std::to_string(report.limited),
                               std::to_string(report.jumps),
                               exact(report.jump_residual)};
  if (case_.is_explicit()) {
    const fem::QuasiStatic& row_of = report.quasi_static;
    for (const int count : {report.explicit_steps, report.rest_steps}) row.push_back(std::to_string(count));
    for (const double share : {row_of.reaction_difference, row_of.nodes_unbalanced, row_of.grains_unbalanced,
                               row_of.kinetic_share, row_of.hot_points, row_of.error()})
      row.push_back(exact(share));
  }
  if (case_.is_automatic()) row.push_back(std::to_string(report.given_up));
  if (case_.rate_follows) row.push_back(exact(report.speed));
  if (case_.real_time)
    for (const double energy : {report.energies.external, report.energies.internal, report.energies.kinetic,
                                report.energies.damped, report.energies.absorbed, report.energies.error()})
      row.push_back(exact(energy));
  if (!case_.stages.empty()) {
    const coupler::CaseStage* const stage = case_.stage_of(step.step);
    row.push_back(std::to_string(stage == nullptr ? 0 : stage - case_.stages.data() + 1));
  }
  for (const auto& [name, value] : step.values) {
    if (name != "time") row.push_back(exact(value));
  }
  history_.add(row);
}

void RunFiles::add(int step, const Costs& costs, const coupler::PoolCounts& counts) {
  std::vector<std::string> row{std::to_string(step)};
  for (const double seconds :
       {costs.total, costs.grains, costs.messages, costs.waiting, costs.finite_elements, costs.rest}) {
    row.push_back(fmt::format("{:.6f}", seconds));
  }
  for (const std::int64_t whole :
       {counts.evaluations, counts.dem_steps, counts.bytes_sent, counts.bytes_received}) {
    row.push_back(std::to_string(whole));
  }
  costs_.add(row);
}

template <int dim>
void RunFiles::write(const CommittedStep& step, const fem::Solver<dim>& solver) {
  write_rows();
  if (has_fields(step.step) || !step.report.converged) write_fields(step.step, solver);
}

void RunFiles::write_rows() {
  history_.write();
  costs_.write();
}

template <int dim>
void RunFiles::write_fields(int step, const fem::Solver<dim>& solver) {
  std::error_code error;
  // Not the result directory itself: when that was removed, somebody has to be told.
  std::filesystem::create_directory(directory_ / "fields", error);  // write_vtu says when it is not there
  fem::Fields fields = fem::collect_fields(solver);
  name_units(fields.points);
  name_units(fields.cells);
  fem::write_vtu(directory_ / fields_file(step), solver.problem().mesh, fields);
  collection_.add(solver.state().time, fields_file(step));
  write_structures(directory_ / "fields", step, solver);
  if (!case_.profiles.empty()) std::filesystem::create_directory(directory_ / "profiles", error);
  for (const coupler::Profile& profile : case_.profiles)
    write_profile(directory_ / profile_file(profile.name, step), profile, solver, case_.regions);
  if (!case_.output_points) return;
  fem::PlacedFields at_points = fem::collect_point_fields(solver);
  name_units(at_points.fields);
  fem::write_vtu(directory_ / points_file(step), at_points);
  points_collection_.add(solver.state().time, points_file(step));
}

template void RunFiles::write<2>(const CommittedStep& step, const fem::Solver<2>& solver);
template void RunFiles::write<3>(const CommittedStep& step, const fem::Solver<3>& solver);

std::vector<CommittedStep> steps_of_history(const std::string& history, const coupler::Case& the_case) {
  const std::vector<std::string> columns = history_columns(the_case);
  std::istringstream lines(history);
  std::string line;
  std::getline(lines, line);
  if (cells_of(line) != columns) throw RunError("history.csv has other columns than the case");
  std::vector<CommittedStep> steps;
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != columns.size()) throw RunError("a row of history.csv is broken: " + line);
    const auto real = [&](std::size_t column) { return std::strtod(cells[column].c_str(), nullptr); };
    const auto whole = [&](std::size_t column) { return std::strtol(cells[column].c_str(), nullptr, 10); };
    CommittedStep step;
    step.step = static_cast<int>(whole(0));
    fem::StepReport& report = step.report;
    report.converged = true;
    report.time = real(1);
    report.substeps = static_cast<int>(whole(2));
    report.cuts = static_cast<int>(whole(3));
    report.iterations = static_cast<int>(whole(4));
    report.evaluations = whole(5);
    report.force_residual = real(6);
    report.moment_residual = real(7);
    report.force_noise = real(8);
    report.within_noise = static_cast<int>(whole(9));
    report.within_rounding = static_cast<int>(whole(10));
    report.limited = static_cast<int>(whole(11));
    report.jumps = static_cast<int>(whole(12));
    report.jump_residual = real(13);
    if (the_case.is_explicit()) {
      report.explicit_steps = static_cast<int>(whole(14));
      report.rest_steps = static_cast<int>(whole(15));
      report.quasi_static = {.reaction_difference = real(16),
                             .kinetic_share = real(19),
                             .nodes_unbalanced = real(17),
                             .grains_unbalanced = real(18),
                             .hot_points = real(20)};
    }
    if (the_case.is_automatic()) report.given_up = static_cast<int>(whole(22));
    if (the_case.rate_follows) report.speed = real(the_case.is_automatic() ? 23 : 22);
    if (the_case.real_time) {
      report.energies = {.kinetic = real(24),
                         .internal = real(23),
                         .external = real(22),
                         .damped = real(25),
                         .absorbed = real(26)};
    }
    step.values.emplace_back("time", report.time);
    for (std::size_t c = columns_of_steps(the_case).size(); c < cells.size(); ++c)
      step.values.emplace_back(columns[c], real(c));
    steps.push_back(std::move(step));
    if (the_case.real_time)
      steps.back().report.energies.at_start =
          std::max(std::abs(value_of(steps.front().values, "external_work")),
                   std::abs(value_of(steps.front().values, "internal_work")));
  }
  return steps;
}

}  // namespace polargrain::app
