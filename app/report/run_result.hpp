// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/csv_table.hpp"

namespace polargrain::app {

/// One iteration of a run, as its log tells it.
struct LoggedIteration {
  int step;
  int number;  ///< within its attempt at the step; 1 is the predictor
  double force_residual;
  double moment_residual;
};

/// A warning or an error of a log.
struct LoggedWarning {
  int step;  ///< -1: before the first
  std::string text;
};

/// The content of a result directory, as far as it is there: a run may be at work in it.
struct RunResult {
  std::filesystem::path directory;
  std::string name;  ///< of the directory, for legends
  std::optional<CsvTable> history;
  std::optional<CsvTable> costs;
  nlohmann::ordered_json summary;  ///< null until a run has come to an end
  /// Whether its body lies in space; pages show no picture of it then.
  [[nodiscard]] bool is_in_space() const { return summary.is_object() && summary.value("dimension", 2) == 3; }
  std::vector<LoggedIteration> iterations;
  std::vector<LoggedWarning> warnings;
  std::string head;         ///< first line of the log: version, title, case file
  bool is_at_work = false;  ///< another process holds the directory
  /// Step and file of each field file, in order.
  std::vector<std::pair<int, std::filesystem::path>> fields;

  /// Title of the case; of a run without a summary the head of its log.
  [[nodiscard]] std::string title() const;
  /// Names of the values that history.csv holds of each step behind the figures of the solver: built-in values and monitors.
  [[nodiscard]] std::vector<std::string> value_names() const;
};

/// @throws InputError when there is no result of a run
RunResult read_result(const std::filesystem::path& directory);

/// Whether a run is at work in the directory.
bool is_at_work(const std::filesystem::path& directory);

}  // namespace polargrain::app
