// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/remarks/remark.hpp"
#include "app/run/costs.hpp"
#include "app/run/monitor_values.hpp"

namespace polargrain::app {

/// A committed step as the table and the summary need it.
struct CommittedStep {
  int step = 0;
  fem::StepReport report;
  MonitorValues values;
};

/// All that is known of a run when it ends.
struct RunRecord {
  std::string status = "running";  ///< then "done", "failed" or "stopped" (by a signal)
  std::string message;             ///< why it failed
  int workers = 0;                 ///< 0: no material needed any
  std::vector<CommittedStep> steps;
  fem::StepWork work;  ///< of all steps, that of a step that was not reached included
  coupler::PoolCounts pool;
  Costs costs;
  /// The cost and error that materials report, by region; only of materials that report them.
  std::map<std::string, std::vector<fem::Figure>> figures;
  Remarks remarks;                             ///< on the case, before it began
  std::map<std::string, std::string> doubts;   ///< the answers that materials cannot vouch for, by region
  std::map<std::string, std::string> limits;   ///< which points are at limits of their grains, by region
  std::vector<std::string> settings;           ///< of --set
  std::map<std::string, std::string> results;  ///< names of contents, see names_of_results
  std::map<std::string, coupler::WorkerRecord>
      worker_records;  ///< since the run was started, or resumed, last

  /// Counts a step; one without values, which was not reached at all, is counted only.
  void add(CommittedStep step);
};

/// Writes summary.json: status, figures of cost and error, last values of the monitors.
/// @throws RunError when it cannot be written
void write_summary(const std::filesystem::path& file, const coupler::Case& the_case, const RunRecord& record);

/// The table a run ends with: at most some twenty steps, evenly spaced, the last one always.
std::string table_text(const coupler::Case& the_case, const RunRecord& record);

/// The time spent and the cost of the cells.
std::string costs_text(const RunRecord& record);

/// The cost and error that materials report; empty when no material reports them.
std::string figures_text(const RunRecord& record);

}  // namespace polargrain::app
