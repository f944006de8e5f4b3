// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/layer/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "app/commands/csv_file.hpp"
#include "app/layer/column.hpp"
#include "app/layer/grain_layer.hpp"
#include "app/layer/jobs.hpp"
#include "app/layer/lengths.hpp"
#include "app/pack/read_specification.hpp"
#include "app/run/interrupt.hpp"
#include "common/error.hpp"
#include "common/mean_and_interval.hpp"
#include "common/packing_file.hpp"
#include "common/regular_file.hpp"
#include "common/standard_streams.hpp"
#include "common/write_file.hpp"
#include "coupler/case/cell_script.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/case/measured_length.hpp"

namespace polargrain::app {
namespace {

class Measurement {
 public:
  Measurement(const LayerOptions& options, const PackingTools& tools)
      : options_(options),
        tools_(tools),
        specification_(read_packing_specification(options.specification, settings_of(options.grains, 1),
                                                  options.scripts)),
        script_(layer_script(specification_.script, specification_.script_file)),
        jobs_(2 * options.seeds.size() + options.cell_seeds.size() * (1 + candidates()), options.quiet) {
    read_packing_specification(options.specification, settings_of(options.cell_grains, 1), options.scripts);
    refuse_turned_bedding(specification_, options.specification, options.settings);
    for (const std::filesystem::path& packing : options.beside) read_packing(packing);
    check_script_is_elsewhere();
    std::filesystem::create_directories(options.directory);
    check_origin();
    write_file(options.directory / "cell.in", specification_.script);
  }

  int measure() {
    const std::vector<LayerFigures> layers = shear_layers();
    std::vector<FoundLengths> found;
    CsvFile table(options_.directory / "columns.csv",
                  joined({"cells", "lc", "lp"}, figure_names(), {"complete"}));
    for (const int seed : options_.cell_seeds) found.push_back(lengths_like(layers, columns(seed, table)));
    if (incomplete_columns_ > 0 && !options_.quiet)
      tell(
          stderr,
          "{} of {} columns of cells did not come {:.3g} diameters past their peak ('complete' 0 in columns.csv): lc and lp "
          "rest on them as far as they came; try other candidates (--lc, --lp), more --cell-grains, or a smaller --way\n",
          incomplete_columns_, options_.cell_seeds.size() * candidates(), options_.way);
    conclude(layers, found);
    return 0;
  }

 private:
  /// A script with what it includes is written as cell.in, which the script itself may be called.
  void check_script_is_elsewhere() const {
    const std::filesystem::path written = options_.directory / "cell.in";
    const std::string reason = why_not_over(written, coupler::files_of_script(specification_.script_file));
    if (!reason.empty() && coupler::content_of(written) != specification_.script)
      throw InputError({written.string(), 0, reason + ", or another folder with -o"});
  }

  [[nodiscard]] std::vector<std::string> settings_of(int grains, int seed) const {
    std::vector<std::string> settings = options_.settings;
    settings.push_back(fmt::format("grains={}", grains));
    settings.push_back(fmt::format("seed={}", seed));
    return settings;
  }
  [[nodiscard]] std::size_t candidates() const {
    return options_.internal_lengths.size() * std::max<std::size_t>(1, options_.plastic_lengths.size());
  }
  static std::vector<std::string> figure_names() {
    std::vector<std::string> names;
    for (const auto& [name, value] : LayerFigures{}.values()) names.push_back(name);
    return names;
  }
  static std::vector<std::string> joined(std::vector<std::string> first,
                                         const std::vector<std::string>& second,
                                         const std::vector<std::string>& third) {
    first.insert(first.end(), second.begin(), second.end());
    first.insert(first.end(), third.begin(), third.end());
    return first;
  }
  static std::vector<std::string> cells_of(const LayerFigures& figures) {
    std::vector<std::string> cells;
    for (const auto& [name, value] : figures.values()) cells.push_back(fmt::format("{:.6g}", value));
    return cells;
  }

  /// A folder holds what was made of one specification in one way.
  void check_origin() const {
    const std::string origin = fmt::format(
        "{}\n# settings\n{}\n# contact law {}\n# inertial number {:.17g}, shear {:.17g}, way {:.17g}, column {:.17g} of "
        "{} elements\n",
        specification_.text, fmt::join(options_.settings, "\n"),
        coupler::name_of_script(specification_.script), options_.inertial_number, options_.shear,
        options_.way, options_.column_height, options_.elements);
    const std::filesystem::path note = options_.directory / "origin.txt";
    if (std::filesystem::exists(note) && coupler::content_of(note) != origin)
      throw InputError(
          {options_.directory.string(), 0,
           "holds layers of another specification, script or way of shearing (origin.txt); name another "
           "folder with -o, or remove it"});
    write_file(note, origin);
  }

  std::filesystem::path packing(int grains, int seed) {
    const std::filesystem::path file = options_.directory / fmt::format("grains{}-seed{}.h5", grains, seed);
    const bool there = std::filesystem::exists(file);
    jobs_.next(fmt::format("packing of {} grains, seed {}", grains, seed), there);
    if (there) return file;
    const PackingSpecification asked =
        read_packing_specification(options_.specification, settings_of(grains, seed), options_.scripts);
    make_packing_file([&](const auto& progress) { return tools_.make(asked, progress); }, file, tools_,
                      options_.quiet);
    return file;
  }

  std::vector<LayerFigures> shear_layers() {
    std::vector<LayerFigures> layers;
    CsvFile table(options_.directory / "layers.csv", joined({"seed"}, figure_names(), {"complete"}));
    for (const int seed : options_.seeds) {
      const Packing grains = read_packing(packing(options_.grains, seed));
      diameter_ = 2.0 * grains.mean_radius();
      const std::filesystem::path folder =
          options_.directory / fmt::format("layer{}-seed{}", options_.grains, seed);
      jobs_.next(fmt::format("layer of {} grains, seed {}", options_.grains, seed),
                 std::filesystem::exists(folder / "done"));
      shear_layer(grains, script_,
                  {specification_.pressure, specification_.density, options_.inertial_number, options_.shear},
                  folder, tools_, options_.quiet);
      layers.push_back(figures_of(read_layer(folder, specification_.pressure), diameter_, options_.way));
      table.add(
          joined({std::to_string(seed)}, cells_of(layers.back()), {layers.back().complete ? "1" : "0"}));
    }
    table.write();
    const auto incomplete = std::ranges::count_if(layers, [](const auto& layer) { return !layer.complete; });
    if (incomplete > 0 && !options_.quiet)
      tell(
          stderr,
          "{} of {} layers did not come {:.3g} diameters past their peak: they are compared as far as they came; a "
          "larger --shear takes them there\n",
          incomplete, layers.size(), options_.way);
    return layers;
  }

  Candidates columns(int seed, CsvFile& table) {
    const std::filesystem::path cells = packing(options_.cell_grains, seed);
    const double diameter = 2.0 * read_packing(cells).mean_radius();
    Candidates made;
    made.internal = options_.internal_lengths;
    made.plastic = options_.plastic_lengths;
    for (const double lc : made.internal) {
      std::vector<LayerFigures> row;
      for (std::size_t j = 0; j < std::max<std::size_t>(1, made.plastic.size()); ++j)
        row.push_back(column(cells, diameter, lc,
                             made.plastic.empty() ? std::nullopt : std::optional(made.plastic[j]), seed,
                             table));
      made.figures.push_back(row);
    }
    return made;
  }

  LayerFigures column(const std::filesystem::path& cells, double diameter, double lc,
                      std::optional<double> lp, int seed, CsvFile& table) {
    ColumnSpecification column;
    column.script = "cell.in";
    column.packing = cells.filename();
    column.pressure = specification_.pressure;
    column.diameter = diameter;
    column.height = options_.column_height * diameter;
    column.elements = options_.elements;
    column.internal_length = lc * diameter;
    if (lp) column.plastic_length = *lp * diameter;
    column.way = options_.way;
    const std::string lengths = lp ? fmt::format("lc{:g}-lp{:g}", lc, *lp) : fmt::format("lc{:g}", lc);
    const std::filesystem::path folder =
        options_.directory / fmt::format("column-cells{}-seed{}-{}", options_.cell_grains, seed, lengths);
    jobs_.next(fmt::format("column of cells, seed {}, {}", seed, lengths),
               std::filesystem::exists(folder / "ended"));
    run_column(column, folder, options_.workers, options_.scripts);
    const LayerFigures figures = figures_of(read_column(column, folder), diameter, options_.way);
    if (!figures.complete) ++incomplete_columns_;
    table.add(joined({std::to_string(seed), fmt::format("{:g}", lc), lp ? fmt::format("{:g}", *lp) : "none"},
                     cells_of(figures), {figures.complete ? "1" : "0"}));
    table.write();
    return figures;
  }

  /// The mean of logarithms, with the interval as two ends, in mean diameters.
  static std::array<double, 3> geometric(const std::vector<double>& values) {
    std::vector<double> logarithms;
    for (const double value : values) logarithms.push_back(std::log(value));
    const auto [mean, half] = mean_and_interval(logarithms);
    return {std::exp(mean), std::exp(mean - half), std::exp(mean + half)};
  }

  void conclude(const std::vector<LayerFigures>& layers, const std::vector<FoundLengths>& found) const {
    std::vector<double> internal;
    std::vector<double> plastic;
    int at_edge = 0;
    CsvFile table(options_.directory / "lengths.csv",
                  {"cells", "lc", "lp", "misfit", "at_edge", "halfway", "end", "thickness"});
    for (std::size_t k = 0; k < found.size(); ++k) {
      const FoundLengths& one = found[k];
      internal.push_back(one.internal);
      if (one.plastic) plastic.push_back(*one.plastic);
      at_edge += one.at_edge ? 1 : 0;
      table.add({std::to_string(options_.cell_seeds[k]), fmt::format("{:.4g}", one.internal),
                 one.plastic ? fmt::format("{:.4g}", *one.plastic) : "none",
                 fmt::format("{:.4g}", one.misfit), one.at_edge ? "1" : "0",
                 fmt::format("{:.4g}", one.figures.halfway), fmt::format("{:.4g}", one.figures.end),
                 fmt::format("{:.4g}", one.figures.thickness)});
    }
    table.write();
    const std::array<double, 3> lc = geometric(internal);
    std::string text = fmt::format(
        "# Lengths of the Cosserat layer of cells that is like layers of the same grains; polargrain layer wrote this, a case reads "
        "it\n# with `lc: measured`. Intervals hold the mean with 95 %, over the packings of cells.\n");
    const auto entry = [&](const char* key, const std::array<double, 3>& length) {
      text += fmt::format("{}: {:.6g} m   # {:.3g} mean diameters\n", key, diameter_ * length[0], length[0]);
      if (std::isfinite(length[1]))
        text += fmt::format("{}_interval: [{:.6g} m, {:.6g} m]\n", key, diameter_ * length[1],
                            diameter_ * length[2]);
    };
    entry("lc", lc);
    if (!plastic.empty()) entry("lp", geometric(plastic));
    text +=
        fmt::format("mean_diameter: {:.10g} m\nscript: {}\nlayers: {}\ncells: {}\nat_edge: {}\n", diameter_,
                    coupler::name_of_script(specification_.script), layers.size(), found.size(), at_edge);
    for (const int seed : options_.cell_seeds)
      write_file(coupler::length_file_of(options_.directory /
                                         fmt::format("grains{}-seed{}.h5", options_.cell_grains, seed)),
                 text);
    for (const std::filesystem::path& packing : options_.beside)
      write_file(coupler::length_file_of(packing), text);
    if (options_.quiet) return;
    show(layers);
    tell(stdout, "\n{}", text);
    if (at_edge > 0)
      tell(
          stdout,
          "\n{} of {} packings of cells have their best length at the first or last candidate: try others (--lc, "
          "--lp)\n",
          at_edge, found.size());
  }

  static void show(const std::vector<LayerFigures>& layers) {
    tell(
        stdout,
        "layers of grains, mean and 95 % interval over {} (lengths in mean diameters, stresses over the peak):\n",
        layers.size());
    const auto names = LayerFigures{}.values();
    for (std::size_t k = 0; k < names.size(); ++k) {
      std::vector<double> values;
      for (const LayerFigures& layer : layers) values.push_back(layer.values()[k].second);
      const auto [mean, half] = mean_and_interval(values);
      tell(stdout, "  {:<10} {:.3g} +- {:.2g}\n", names[k].first, mean, half);
    }
  }

  const LayerOptions& options_;
  const PackingTools& tools_;
  PackingSpecification specification_;
  LayerScript script_;
  Jobs jobs_;
  double diameter_ = 0.0;  ///< mean one of the grains, m
  std::size_t incomplete_columns_ = 0;
};

}  // namespace

int measure_layer(const LayerOptions& options, const PackingTools& tools) {
  note_interrupts();
  return Measurement(options, tools).measure();
}

}  // namespace polargrain::app
