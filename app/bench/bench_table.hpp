// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/bench/bench_sizes.hpp"

namespace polargrain::app {

/// The settings compared in a bench.
struct BenchAxes {
  std::string x;               ///< monitor along the curves
  std::vector<std::string> y;  ///< monitors whose error counts
  bool band = false;           ///< whether shear bands were looked for
  std::string x_unit = {};     ///< empty: without one, or not known
  std::vector<std::string> y_units = {};
};

/// One figure of a row.
struct BenchColumn {
  std::string name;     ///< in bench.csv
  std::string title;    ///< for people
  double scale = 1.0;   ///< from the value in bench.csv to the one that people read
  std::string pattern;  ///< how fmt writes the latter
};

/// A run, or the mean or the standard deviation of the packings of one size.
struct BenchRow {
  std::string case_file;
  std::string what;
  std::string setting;
  std::string status;        ///< "done", why it stopped, or how many packings were averaged
  std::optional<int> steps;  ///< of a run
  std::optional<double> seconds;
  std::optional<double> evaluations;
  std::optional<double> dem_steps;
  std::vector<std::optional<double>> figures;  ///< one for each column; in SI units and shares
  std::string no_band;                         ///< why, where bands were looked for
  bool on_front = false;
};

struct BenchTable {
  bool band = false;
  std::vector<BenchColumn> columns;
  std::vector<BenchRow> rows;
};

/// Runs in their order, then the sizes: mean and, of two packings or more, standard deviation.
BenchTable bench_table(const BenchAxes& axes, const std::vector<BenchResult>& results,
                       const std::vector<SizeScatter>& sizes);

/// Titles and rows of cells for people.
std::vector<std::string> titles_of(const BenchTable& table);
std::vector<std::string> cells_of(const BenchTable& table, const BenchRow& row);

/// The table as Markdown, for standard output and a README.
std::string markdown(const BenchTable& table);

/// Writes it as CSV (docs/file_formats.md). @throws RunError when it cannot be written
void write_csv(const std::filesystem::path& file, const BenchTable& table);

/// The result that the sizes are compared with; empty where there are no sizes.
std::string reference_of_sizes(const std::vector<SizeScatter>& sizes);

}  // namespace polargrain::app
