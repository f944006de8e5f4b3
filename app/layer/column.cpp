// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/layer/column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/run/run.hpp"
#include "common/csv_table.hpp"
#include "common/error.hpp"
#include "common/write_file.hpp"

namespace polargrain::app {
namespace {

/// Shear up to which the plate is driven; then the way between two rows of nodes on either side of the middle is, because
/// behind its peak a column snaps back.
constexpr double kDriven = 0.02;
constexpr double kBelow = 0.3;
constexpr int kStepsOfDiameter = 12;
/// Before the peak, of displacement between those rows, in diameters.
constexpr double kBeforePeak = 1.0;
/// Of the plate before the peak, in diameters; in explicit steps.
constexpr double kPlateBeforePeak = 1.5;

/// Rows of nodes: those between two elements, and those in the middle of elements. In explicit steps elements have one point and half
/// the size: the points of larger ones part from each other, which nothing spreads (docs/theory/spread.md).
int rows_of(const ColumnSpecification& column) {
  return 2 * column.elements + 1;
}

int elements_of(const ColumnSpecification& column) {
  return column.explicit_steps ? 2 * column.elements : column.elements;
}

/// Whether nodes have micro-rotations.
bool turns(const ColumnSpecification& column) {
  return column.spread == 0.0;
}

double width_of(const ColumnSpecification& column) {
  return column.height / elements_of(column);
}

/// In explicit steps, where the plate goes the height by time 10.
double end_of_drive(const ColumnSpecification& column) {
  return 10.0 * std::max(2.0 * kDriven, (column.way + kPlateBeforePeak) * column.diameter / column.height);
}

std::string steps_of(const ColumnSpecification& column) {
  std::string text = fmt::format("steps:\n  stages:\n    - {{until: {:.17g}, count: 8}}\n", 10.0 * kDriven);
  if (column.explicit_steps)
    return text +
           fmt::format("    - {{until: {:.8g}, count: {}}}\n  method: explicit\n", end_of_drive(column),
                       static_cast<int>(std::ceil(kStepsOfDiameter * (column.way + kPlateBeforePeak))));
  const int last = rows_of(column) - 1;
  const int below = 2 * static_cast<int>(std::lround(kBelow * column.elements));
  const double grow = (column.way + kBeforePeak) * column.diameter;
  text += fmt::format(
      "    - {{measure: {{on: y{}, from: y{}, displacement: u1}}, grow: {:.17g}, count: {}}}\n", last - below,
      below, grow, static_cast<int>(std::ceil(kStepsOfDiameter * (column.way + kBeforePeak))));
  text += "  cut: 12\n  noise: 2\n  acceleration: 5\n";
  // A spread slip sets many boxes in motion at once: jumps are more, and what does not balance soon is better cut.
  return text + (turns(column) ? "  tolerance: 1e-2\n  jumps: 20\n"
                               : "  tolerance: 2e-2\n  jumps: 100\n  iterations: 15\n");
}

}  // namespace

std::string column_case(const ColumnSpecification& column) {
  const int last = rows_of(column) - 1;
  std::string levels;
  std::string monitors;
  for (int row = 0; row <= last; ++row) {
    levels += fmt::format("{}y{}: {:.17g}", row == 0 ? "" : ", ", row, column.height * row / last);
    monitors += fmt::format("  u{0}: {{on: y{0}, displacement: u1}}\n", row);
    if (turns(column)) monitors += fmt::format("  w{0}: {{on: y{0}, displacement: w}}\n", row);
  }
  std::string text =
      "title: A layer of cells with given lengths, made by polargrain layer\ndeformation: large\n";
  if (!turns(column))
    text += fmt::format("continuum: {{kind: cauchy, spread: {:.17g}, hold: [bottom, top]}}\n", column.spread);
  text += column.explicit_steps ? "mesh:\n  element: Q4R\n" : "mesh:\n";
  text +=
      fmt::format("  rectangle:\n    size: [{:.17g}, {:.17g}]\n    elements: [1, {}]\n    levels: {{{}}}\n",
                  width_of(column), column.height, elements_of(column), levels);
  text += fmt::format("materials:\n  sand: {{model: cell, script: {}, packing: {}", column.script.string(),
                      column.packing.string());
  if (turns(column)) {
    text += fmt::format(", lc: {:.17g}", column.internal_length);
    text += column.plastic_length ? fmt::format(", lp: {:.17g}", *column.plastic_length) : ", lp: none";
  }
  text += fmt::format(
      "}}\nregions: {{all: sand}}\nboundary:\n  - {{on: left, tie: right}}\n  - {{on: bottom, fix: [u1, u2{}]}}\n",
      turns(column) ? ", w" : "");
  const double driven = column.explicit_steps ? std::max(10.0, end_of_drive(column)) : 10.0;
  text +=
      fmt::format("  - {{on: top, {}move: {{u1: [[0, 0], [{:.8g}, {:.17g}]]}}, pressure: {:.17g}}}\n",
                  turns(column) ? "fix: [w], " : "", driven, 0.1 * driven * column.height, column.pressure);
  text += steps_of(column) + "monitors:\n";
  text += "  shear_force: {on: top, reaction: u1}\n  displacement: {on: top, displacement: u1}\n" + monitors;
  text += "output: {every: 1000, points: no, table: [displacement, shear_force]}\n";
  return text;
}

void run_column(const ColumnSpecification& column, const std::filesystem::path& folder, int workers,
                const ScriptRules& scripts) {
  if (std::filesystem::exists(folder / "ended")) return;
  std::filesystem::create_directories(folder);
  const std::filesystem::path case_file = folder.parent_path() / (folder.filename().string() + ".yaml");
  write_file(case_file, column_case(column));
  RunOptions options;
  options.case_file = case_file;
  options.directory = folder;
  options.workers = workers;
  options.quiet = true;
  options.scripts = scripts;
  options.resume = std::filesystem::exists(folder / "checkpoint.h5");
  const int status = run(options);
  write_file(folder / "ended", status == 0 ? "complete\n" : "could not go on\n");
}

Shearing read_column(const ColumnSpecification& column, const std::filesystem::path& folder) {
  const CsvTable history(folder / "history.csv");
  Shearing shearing;
  shearing.displacements = history.numbers("displacement");
  for (const double force : history.numbers("shear_force"))
    shearing.ratios.push_back(force / (width_of(column) * column.pressure));
  const int rows = rows_of(column);
  shearing.frames.resize(history.rows());
  for (std::size_t k = 0; k < shearing.frames.size(); ++k) {
    Shearing::Frame& frame = shearing.frames[k];
    frame.displacement = shearing.displacements[k];
    frame.heights = Eigen::VectorXd::LinSpaced(rows, 0.0, column.height);
    frame.along.resize(rows);
    frame.rotations.resize(rows);
    for (int row = 0; row < rows; ++row) {
      frame.along[row] = history.number(k, history.column(fmt::format("u{}", row)));
      frame.rotations[row] = turns(column) ? history.number(k, history.column(fmt::format("w{}", row)))
                                           : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return shearing;
}

}  // namespace polargrain::app
