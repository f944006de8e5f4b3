// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/layer/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <map>
#include <numeric>

#include "app/commands/csv_file.hpp"
#include "app/layer/column.hpp"
#include "app/layer/descriptions.hpp"
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
        descriptions_(descriptions_of(options)),
        jobs_(
            2 * options.seeds.size() + (options.columns ? options.cell_seeds.size() * (1 + candidates()) : 0),
            options.quiet) {
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
    if (!options_.columns) {
      if (!options_.quiet) show(layers);
      return 0;
    }
    CsvFile table(options_.directory / "columns.csv",
                  joined({{"cells", "lc", "lp", "spread"}, figure_names(), {"complete"}}));
    for (const int seed : options_.cell_seeds)
      for (Description& description : descriptions_)
        description.found.push_back(lengths_like(layers, columns(description, seed, table)));
    if (incomplete_columns_ > 0 && !options_.quiet)
      tell(
          stderr,
          "{} of {} columns of cells did not come {:.3g} diameters past their peak ('complete' 0 in columns.csv): lengths "
          "rest on them as far as they came; try other candidates (--lc, --lp, --spread), more --cell-grains, or a smaller --way\n",
          incomplete_columns_, options_.cell_seeds.size() * candidates(), options_.way);
    write_lengths();
    conclude(layers);
    return 0;
  }

 private:
  /// The packing of the cells of columns. @param diameter mean one, m
  struct Cells {
    std::filesystem::path packing;
    double diameter = 0.0;
    bool spheres = false;
  };

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
    std::size_t count = 0;
    for (const Description& description : descriptions_) count += description.columns();
    return count;
  }
  static std::vector<std::string> figure_names() {
    std::vector<std::string> names;
    for (const auto& [name, value] : LayerFigures{}.values()) names.push_back(name);
    return names;
  }
  static std::vector<std::string> joined(std::initializer_list<std::vector<std::string>> parts) {
    std::vector<std::string> all;
    for (const std::vector<std::string>& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
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
    CsvFile table(options_.directory / "layers.csv", joined({{"seed"}, figure_names(), {"complete"}}));
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
          joined({{std::to_string(seed)}, cells_of(layers.back()), {layers.back().complete ? "1" : "0"}}));
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

  Candidates columns(const Description& description, int seed, CsvFile& table) {
    const Cells& cells = cells_of_column(seed);
    Candidates made{description.first, description.second, {}};
    for (const double first : made.first) {
      made.figures.emplace_back();
      for (std::size_t j = 0; j < std::max<std::size_t>(1, made.second.size()); ++j) {
        const auto second = made.second.empty() ? std::nullopt : std::optional(made.second[j]);
        made.figures.back().push_back(column(description, cells, first, second, seed, table));
      }
    }
    return made;
  }

  /// The packing of the cells of columns, made once.
  const Cells& cells_of_column(int seed) {
    const auto [place, is_new] = cells_.try_emplace(seed);
    if (is_new) {
      place->second.packing = packing(options_.cell_grains, seed);
      const Packing made = read_packing(place->second.packing);
      place->second.diameter = 2.0 * made.mean_radius();
      place->second.spheres = made.dimension == 3;
    }
    return place->second;
  }

  LayerFigures column(const Description& description, const Cells& cells, double first,
                      std::optional<double> second, int seed, CsvFile& table) {
    const double diameter = cells.diameter;
    ColumnSpecification column;
    column.script = "cell.in";
    column.packing = cells.packing.filename();
    column.pressure = specification_.pressure;
    column.diameter = diameter;
    column.height = options_.column_height * diameter;
    column.elements = options_.elements;
    (description.spreads ? column.spread : column.internal_length) = first * diameter;
    if (second) column.plastic_length = *second * diameter;
    column.way = options_.way;
    column.explicit_steps = cells.spheres;
    const std::string lengths = description.spreads ? fmt::format("spread{:g}", first)
                                : second            ? fmt::format("lc{:g}-lp{:g}", first, *second)
                                                    : fmt::format("lc{:g}", first);
    const std::filesystem::path folder =
        options_.directory / fmt::format("column-cells{}-seed{}-{}", options_.cell_grains, seed, lengths);
    jobs_.next(fmt::format("column of cells, seed {}, {}", seed, lengths),
               std::filesystem::exists(folder / "ended"));
    run_column(column, folder, options_.workers, options_.scripts);
    const LayerFigures figures = figures_of_column(column, folder, lengths);
    if (!figures.complete) ++incomplete_columns_;
    table.add(joined({{std::to_string(seed)},
                      lengths_in_table(description, first, second, "{:g}"),
                      cells_of(figures),
                      {figures.complete ? "1" : "0"}}));
    table.write();
    return figures;
  }

  [[nodiscard]] LayerFigures figures_of_column(const ColumnSpecification& column,
                                               const std::filesystem::path& folder,
                                               const std::string& lengths) const {
    const Shearing shearing = read_column(column, folder);
    try {
      return figures_of(shearing, column.diameter, options_.way);
    } catch (const RunError&) {
      throw RunError(fmt::format(
          "the column of cells with {} stopped before it was sheared by a diameter ({}); grains that are softer, or more of "
          "them in a cell, balance more easily; --no-columns shears the layers alone",
          lengths, (folder / "run.log").string()));
    }
  }

  /// The columns lc, lp and spread of a table.
  static std::vector<std::string> lengths_in_table(const Description& description, double first,
                                                   std::optional<double> second, const char* form) {
    const std::string one = fmt::format(fmt::runtime(form), first);
    if (description.spreads) return {"none", "none", one};
    return {one, second ? fmt::format(fmt::runtime(form), *second) : "none", "none"};
  }

  /// The mean of logarithms, with the interval as two ends, in mean diameters.
  static std::array<double, 3> geometric(const std::vector<double>& values) {
    std::vector<double> logarithms;
    for (const double value : values) logarithms.push_back(std::log(value));
    const auto [mean, half] = mean_and_interval(logarithms);
    return {std::exp(mean), std::exp(mean - half), std::exp(mean + half)};
  }

  void write_lengths() const {
    CsvFile table(options_.directory / "lengths.csv", {"description", "cells", "lc", "lp", "spread", "misfit",
                                                       "at_edge", "halfway", "end", "thickness"});
    for (const Description& description : descriptions_)
      for (std::size_t k = 0; k < description.found.size(); ++k) {
        const FoundLengths& one = description.found[k];
        table.add(joined({{description.name, std::to_string(options_.cell_seeds[k])},
                          lengths_in_table(description, one.first, one.second, "{:.4g}"),
                          {fmt::format("{:.4g}", one.misfit), one.at_edge ? "1" : "0",
                           fmt::format("{:.4g}", one.figures.halfway), fmt::format("{:.4g}", one.figures.end),
                           fmt::format("{:.4g}", one.figures.thickness)}}));
      }
    table.write();
  }

  /// The first length of a description with each packing of cells, or the second.
  static std::vector<double> lengths_of(const Description& description, bool second) {
    std::vector<double> all;
    for (const FoundLengths& one : description.found) all.push_back(second ? *one.second : one.first);
    return all;
  }

  /// A length as a case reads it. @param lengths with each packing of cells, in mean diameters
  [[nodiscard]] std::string entry(const char* key, const std::vector<double>& lengths) const {
    const std::array<double, 3> length = geometric(lengths);
    std::string text =
        fmt::format("{}: {:.6g} m   # {:.3g} mean diameters\n", key, diameter_ * length[0], length[0]);
    if (std::isfinite(length[1]))
      text += fmt::format("{}_interval: [{:.6g} m, {:.6g} m]\n", key, diameter_ * length[1],
                          diameter_ * length[2]);
    return text;
  }

  void conclude(const std::vector<LayerFigures>& layers) const {
    const auto of_case =
        std::ranges::find_if(descriptions_, [](const auto& one) { return !one.second.empty(); });
    const Description& cosserat = of_case == descriptions_.end() ? descriptions_.front() : *of_case;
    std::string text =
        "# Lengths of columns of cells that are like layers of the same grains; polargrain layer wrote this, a case reads it "
        "with\n# `lc: measured` or `spread: measured`. Intervals hold the mean with 95 %, over the packings of cells.\n";
    text += entry("lc", lengths_of(cosserat, false));
    if (!cosserat.second.empty()) text += entry("lp", lengths_of(cosserat, true));
    std::string misfits;
    for (const Description& one : descriptions_) {
      misfits += fmt::format("{}{}: {:.3g}", misfits.empty() ? "" : ", ", one.name,
                             mean_and_interval(one.misfits()).first);
      if (!one.spreads) continue;
      text += entry("spread", lengths_of(one, false));
      text += fmt::format("spread_at_edge: {}\n", one.at_edge());
    }
    text += fmt::format(
        "preferred: {}\nmisfits: {{{}}}\nmean_diameter: {:.10g} m\nscript: {}\nlayers: {}\ncells: {}\nat_edge: {}\n",
        preferred(descriptions_), misfits, diameter_, coupler::name_of_script(specification_.script),
        layers.size(), cosserat.found.size(), cosserat.at_edge());
    for (const int seed : options_.cell_seeds)
      write_file(coupler::length_file_of(options_.directory /
                                         fmt::format("grains{}-seed{}.h5", options_.cell_grains, seed)),
                 text);
    for (const std::filesystem::path& packing : options_.beside)
      write_file(coupler::length_file_of(packing), text);
    if (options_.quiet) return;
    show(layers);
    tell(stdout, "\n{}\n{}", comparison_of(descriptions_), text);
    for (const Description& one : descriptions_)
      if (one.at_edge() > 0)
        tell(
            stdout,
            "\n{}: {} of {} packings of cells have their best length at the first or last candidate: try others\n",
            one.name, one.at_edge(), one.found.size());
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
  std::vector<Description> descriptions_;
  std::map<int, Cells> cells_;  ///< by their seeds
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
