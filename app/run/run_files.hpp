// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <vector>

#include "app/commands/csv_file.hpp"
#include "app/run/costs.hpp"
#include "app/run/summary.hpp"
#include "coupler/checkpoint/checkpoint.hpp"
#include "fem/output/vtu.hpp"

namespace polargrain::app {

/// The files that a run writes while it goes on: history.csv, costs.csv, fields (docs/file_formats.md).
class RunFiles {
 public:
  /// Starts new files, or goes on with those of a checkpoint: later rows are dropped.
  /// @param from null for a new run. Both must outlive this object. @throws RunError when they cannot be
  /// written
  RunFiles(const coupler::Case& the_case, std::filesystem::path directory, const coupler::Checkpoint* from);

  /// Adds a row to history.csv, in memory.
  void add(const CommittedStep& step);
  /// Adds a row to costs.csv, in memory.
  void add(int step, const Costs& costs, const coupler::PoolCounts& counts);
  /// Writes the rows added, and the fields where they are due. @throws RunError
  template <int dim>
  void write(const CommittedStep& step, const fem::Solver<dim>& solver);
  /// Writes the rows added. @throws RunError
  void write_rows();
  /// Writes the fields of a step, at the integration points too where the case wants them. @throws RunError
  template <int dim>
  void write_fields(int step, const fem::Solver<dim>& solver);

  /// Whether fields are written of a step that was reached.
  [[nodiscard]] bool has_fields(int step) const;
  [[nodiscard]] const std::string& history() const { return history_.text(); }
  [[nodiscard]] const std::string& costs() const { return costs_.text(); }

 private:
  void go_on(const coupler::Checkpoint& from);

  const coupler::Case& case_;
  std::filesystem::path directory_;
  CsvFile history_;
  CsvFile costs_;
  fem::PvdCollection collection_;
  fem::PvdCollection points_collection_;
};

/// The committed steps of a history.csv of this case, for the table and the summary.
/// @throws RunError when it is not one
std::vector<CommittedStep> steps_of_history(const std::string& history, const coupler::Case& the_case);

}  // namespace polargrain::app
