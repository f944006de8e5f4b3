// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/bench/bench_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commands/csv_file.hpp"

namespace polargrain::app {
namespace {

using Figures = std::vector<std::optional<double>>;

std::vector<BenchColumn> columns_of(const BenchAxes& axes) {
  std::vector<BenchColumn> columns;
  for (std::size_t k = 0; k < axes.y.size(); ++k) {
    const std::string& y = axes.y[k];
    const std::string unit =
        k < axes.y_units.size() && !axes.y_units[k].empty() ? ", " + axes.y_units[k] : "";
    columns.push_back({"error_" + y, "error of " + y, 100.0, "{:.2f} %"});
    columns.push_back({"peak_" + y, "its peak" + unit, 1.0, "{:.4g}"});
    columns.push_back({"peak_error_" + y, "error of the peak", 100.0, "{:.2f} %"});
  }
  if (!axes.band) return columns;
  columns.push_back({"band_inclination", "band, degrees", 1.0, "{:.1f}"});
  columns.push_back({"band_inclination_difference", "difference", 1.0, "{:.1f}"});
  columns.push_back({"band_thickness", "thickness, mm", 1e3, "{:.1f}"});
  columns.push_back({"band_thickness_difference", "difference", 1e3, "{:.1f}"});
  columns.push_back({"band_onset", "onset, %", 100.0, "{:.2f}"});
  columns.push_back({"band_onset_difference", "difference", 100.0, "{:.2f}"});
  return columns;
}

/// The measures that bands are compared by, of runs and of sizes.
struct BandValues {
  std::optional<double> inclination;
  std::optional<double> thickness;
  std::optional<double> onset;
};

BandValues values_of(const BenchBand& band) {
  return {band.inclination, band.thickness, band.onset};
}

std::optional<double> mean_of(const Spread& spread) {
  return spread.count > 0 ? std::optional(spread.mean) : std::nullopt;
}

BandValues means_of(const SizeScatter& size) {
  return {mean_of(size.inclination), mean_of(size.thickness), mean_of(size.onset)};
}

void add_band(Figures& figures, const BandValues& band, const BandValues& reference) {
  const auto add = [&](const std::optional<double>& value, const std::optional<double>& expected) {
    figures.push_back(value);
    figures.push_back(value && expected ? std::optional(*value - *expected) : std::nullopt);
  };
  add(band.inclination, reference.inclination);
  add(band.thickness, reference.thickness);
  add(band.onset, reference.onset);
}

BenchRow row_of(const BenchAxes& axes, const BenchResult& result, const BandValues& reference) {
  BenchRow row{result.setting.case_file.string(),
               result.setting.group,
               result.setting.label,
               result.status,
               result.steps,
               result.seconds,
               result.evaluations,
               result.dem_steps,
               {},
               result.band.none,
               result.on_front};
  for (std::size_t y = 0; y < axes.y.size(); ++y) {
    const bool compared = y < result.errors.size();
    row.figures.push_back(compared ? std::optional(result.errors[y].largest) : std::nullopt);
    row.figures.push_back(compared ? std::optional(result.peaks[y]) : std::nullopt);
    row.figures.push_back(compared ? std::optional(result.errors[y].peak) : std::nullopt);
  }
  if (axes.band) add_band(row.figures, values_of(result.band), reference);
  return row;
}

void add_size(BenchTable& table, const BenchAxes& axes, const SizeScatter& size, const BandValues& reference,
              const std::string& case_file) {
  BenchRow mean{case_file,
                "mean",
                fmt::format("{} grains", size.grains),
                fmt::format("{} packings", size.packings),
                {},
                size.seconds,
                size.evaluations,
                size.dem_steps,
                {},
                size.inclination.count > 0 ? "" : "no packing has one",
                false};
  BenchRow deviation = mean;
  deviation.what = "standard deviation";
  deviation.seconds = deviation.evaluations = deviation.dem_steps = std::nullopt;
  deviation.no_band.clear();
  for (std::size_t y = 0; y < axes.y.size(); ++y) {
    mean.figures.insert(mean.figures.end(),
                        {size.errors[y].largest, size.peaks[y].mean, size.errors[y].peak});
    deviation.figures.insert(deviation.figures.end(),
                             {size.deviations[y].largest, size.peaks[y].deviation, size.deviations[y].peak});
  }
  if (axes.band) {
    add_band(mean.figures, means_of(size), reference);
    for (const Spread* spread : {&size.inclination, &size.thickness, &size.onset})
      deviation.figures.insert(deviation.figures.end(), {spread->deviation, std::nullopt});
  }
  if (size.packings < 2) return;
  table.rows.push_back(std::move(mean));
  table.rows.push_back(std::move(deviation));
}

std::string number(const std::optional<double>& value, const char* pattern) {
  if (!value) return "";
  const std::string text = fmt::format(fmt::runtime(pattern), *value);
  const bool rounded_to_nothing = text[0] == '-' && text.find_first_of("123456789") == std::string::npos;
  return rounded_to_nothing ? text.substr(1) : text;
}

}  // namespace

BenchTable bench_table(const BenchAxes& axes, const std::vector<BenchResult>& results,
                       const std::vector<SizeScatter>& sizes) {
  BenchTable table{axes.band, columns_of(axes), {}};
  const BandValues reference = values_of(results.front().band);
  BandValues reference_of_sizes;
  for (const SizeScatter& size : sizes)
    if (size.is_reference) reference_of_sizes = means_of(size);
  for (const BenchResult& result : results)
    table.rows.push_back(row_of(axes, result, result.has_own_packing() ? reference_of_sizes : reference));
  for (const SizeScatter& size : sizes)
    add_size(table, axes, size, reference_of_sizes, results.front().setting.case_file.string());
  return table;
}

std::vector<std::string> titles_of(const BenchTable& table) {
  std::vector<std::string> titles{"what", "setting", "status", "s", "cell evaluations", "DEM steps"};
  for (const BenchColumn& column : table.columns) titles.push_back(column.title);
  titles.emplace_back("front");
  return titles;
}

std::vector<std::string> cells_of(const BenchTable& table, const BenchRow& row) {
  const bool stopped = row.steps && row.status != "done";
  std::vector<std::string> cells{row.what,
                                 row.setting,
                                 stopped ? "stopped" : row.status,
                                 number(row.seconds, "{:.1f}"),
                                 number(row.evaluations, "{:.0f}"),
                                 number(row.dem_steps, "{:.0f}")};
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const BenchColumn& column = table.columns[k];
    std::optional<double> value = row.figures[k];
    if (value) value = *value * column.scale;
    const bool says_none = column.name == "band_inclination" && !row.no_band.empty();
    cells.push_back(says_none ? "no band" : number(value, column.pattern.c_str()));
  }
  cells.emplace_back(row.on_front ? "x" : "");
  return cells;
}

std::string markdown(const BenchTable& table) {
  const std::vector<std::string> titles = titles_of(table);
  std::string text = fmt::format("| {} |\n|", fmt::join(titles, " | "));
  for (std::size_t k = 0; k < titles.size(); ++k) text += "---|";
  text += '\n';
  for (const BenchRow& row : table.rows)
    text += fmt::format("| {} |\n", fmt::join(cells_of(table, row), " | "));
  return text;
}

void write_csv(const std::filesystem::path& file, const BenchTable& table) {
  std::vector<std::string> names{"case",  "what",    "setting",          "status",
                                 "steps", "seconds", "cell_evaluations", "dem_steps"};
  for (const BenchColumn& column : table.columns) names.push_back(column.name);
  if (table.band) names.emplace_back("no_band");
  names.emplace_back("front");
  const auto one_cell = [](std::string text) {
    std::replace(text.begin(), text.end(), ',', ';');
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
  };
  CsvFile out(file, names);
  for (const BenchRow& row : table.rows) {
    std::vector<std::string> cells{one_cell(row.case_file),
                                   one_cell(row.what),
                                   one_cell(row.setting),
                                   one_cell(row.status),
                                   row.steps ? std::to_string(*row.steps) : "",
                                   number(row.seconds, "{:.3f}"),
                                   number(row.evaluations, "{:.0f}"),
                                   number(row.dem_steps, "{:.0f}")};
    for (const std::optional<double>& figure : row.figures) cells.push_back(figure ? exact(*figure) : "");
    if (table.band) cells.push_back(one_cell(row.no_band));
    cells.emplace_back(row.on_front ? "1" : "0");
    out.add(cells);
  }
  out.write();
}

std::string reference_of_sizes(const std::vector<SizeScatter>& sizes) {
  for (const SizeScatter& size : sizes) {
    if (!size.is_reference) continue;
    return size.packings == 1 ? fmt::format("the packing of {} grains, in the case as given", size.grains)
                              : fmt::format("the mean of the {} packings of {} grains, in the case as given",
                                            size.packings, size.grains);
  }
  return "";
}

}  // namespace polargrain::app
