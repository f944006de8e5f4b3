// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/layer/measure_interface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "app/commands/csv_file.hpp"
#include "app/layer/grain_layer.hpp"
#include "app/layer/jobs.hpp"
#include "app/layer/wall_row.hpp"
#include "app/layer/wall_shearing.hpp"
#include "app/pack/read_specification.hpp"
#include "app/run/interrupt.hpp"
#include "common/error.hpp"
#include "common/mean_and_interval.hpp"
#include "common/packing_file.hpp"
#include "common/standard_streams.hpp"
#include "common/write_file.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/case/measured_interface.hpp"
#include "coupler/case/measured_length.hpp"

namespace polargrain::app {
namespace {

constexpr double kFrame = 0.1;  ///< slip between two frames, mean diameters
/// Steps to come to rest in, twice: the cut surface comes down on the wall first.
constexpr int kRest = 8000;

class WallMeasurement {
 public:
  WallMeasurement(const InterfaceOptions& options, const PackingTools& tools)
      : options_(options),
        tools_(tools),
        specification_(read_packing_specification(options.specification, settings_of(1), options.scripts)),
        script_(layer_script(specification_.script, specification_.script_file)),
        jobs_(options.seeds.size() * (1 + options.roughnesses.size()), options.quiet) {
    if (script_.spheres)
      throw InputError({specification_.script_file, script_.dimension_line,
                        "is of spheres in space; boxes on walls are made of discs (dimension 2)"});
    refuse_turned_bedding(specification_, options.specification, options.settings);
    for (const std::filesystem::path& packing : options.beside) read_packing(packing);
    std::filesystem::create_directories(options.directory);
    check_origin();
  }

  int measure() {
    std::vector<std::vector<WallFigures>> walls(options_.roughnesses.size());
    std::vector<std::string> names{"roughness", "seed"};
    for (const auto& [name, value] : WallFigures{}.values()) names.push_back(name);
    CsvFile table(options_.directory / "walls.csv", names);
    for (const int seed : options_.seeds) {
      const Packing grains = read_packing(packing(seed));
      diameter_ = 2.0 * grains.mean_radius();
      for (std::size_t k = 0; k < walls.size(); ++k) {
        const double roughness = options_.roughnesses[k];
        walls[k].push_back(sheared(grains, roughness, seed));
        std::vector<std::string> cells{fmt::format("{:g}", roughness), std::to_string(seed)};
        for (const auto& [name, value] : walls[k].back().values())
          cells.push_back(fmt::format("{:.6g}", value));
        table.row(cells);
      }
    }
    conclude(walls);
    return 0;
  }

 private:
  [[nodiscard]] std::vector<std::string> settings_of(int seed) const {
    std::vector<std::string> settings = options_.settings;
    settings.push_back(fmt::format("grains={}", options_.grains));
    settings.push_back(fmt::format("seed={}", seed));
    return settings;
  }
  [[nodiscard]] std::filesystem::path packing_file(int seed) const {
    return options_.directory / fmt::format("grains{}-seed{}.h5", options_.grains, seed);
  }

  /// A folder holds what was made of one specification in one way.
  void check_origin() const {
    const std::string origin = fmt::format(
        "{}\n# settings\n{}\n# contact law {}\n# inertial number {:.17g}, height {:.17g}, way {:.17g}\n",
        specification_.text, fmt::join(options_.settings, "\n"),
        coupler::name_of_script(specification_.script), options_.inertial_number, options_.height,
        options_.way);
    const std::filesystem::path note = options_.directory / "origin.txt";
    if (std::filesystem::exists(note) && coupler::content_of(note) != origin)
      throw InputError({options_.directory.string(), 0,
                        "holds boxes of another specification, script or way of shearing (origin.txt); name "
                        "another folder with -o, or remove it"});
    write_file(note, origin);
  }

  std::filesystem::path packing(int seed) {
    const std::filesystem::path file = packing_file(seed);
    const bool there = std::filesystem::exists(file);
    jobs_.next(fmt::format("packing of {} grains, seed {}", options_.grains, seed), there);
    if (there) return file;
    const PackingSpecification asked =
        read_packing_specification(options_.specification, settings_of(seed), options_.scripts);
    make_packing_file([&](const auto& progress) { return tools_.make(asked, progress); }, file, tools_,
                      options_.quiet);
    return file;
  }

  WallFigures sheared(const Packing& grains, double roughness, int seed) {
    const std::filesystem::path folder =
        options_.directory / fmt::format("grains{}-seed{}-wall{:g}", options_.grains, seed, roughness);
    jobs_.next(fmt::format("wall of roughness {:g}, seed {}", roughness, seed),
               std::filesystem::exists(folder / "done"));
    const OnWall box = on_wall(grains, roughness * diameter_, options_.height * diameter_);
    // Below the plate, above the wall's centres.
    const double height = box.top - kPlateDepth * grains.mean_radius() - box.wall;
    LayerShear shear;
    shear.pressure = specification_.pressure;
    shear.density = specification_.density;
    shear.inertial_number = options_.inertial_number;
    // The height has to be that of the start of the shear, which only the engine knows: a little more slip makes up for it.
    shear.shear = 1.1 * options_.way * diameter_ / height;
    shear.frame = kFrame * diameter_ / height;
    shear.rest = kRest;
    shear_between(box.grains, {box.wall + 1e-3 * box.radius, box.top - kPlateDepth * grains.mean_radius()},
                  script_, shear, folder, tools_, options_.quiet);
    return wall_figures(read_wall_shearing(folder, specification_.pressure, box.wall + box.radius), diameter_,
                        options_.way);
  }

  using Value = double WallFigures::*;
  static std::pair<double, double> mean_of(const std::vector<WallFigures>& boxes, Value value) {
    std::vector<double> values;
    for (const WallFigures& box : boxes) values.push_back(box.*value);
    return mean_and_interval(values);
  }

  void conclude(const std::vector<std::vector<WallFigures>>& walls) const {
    CsvFile curves(options_.directory / "curves.csv",
                   {"roughness", "slip", "friction", "friction_interval", "rise"});
    std::string text = fmt::format(
        "# Friction of grains on rough walls, means over boxes with half of their 95 % intervals; polargrain interface wrote this,\n"
        "# a case reads it with `friction: measured`.\nmean_diameter: {:.10g} m\nscript: {}\npressure: {:g} Pa\nboxes: "
        "{}\nheight: {:g}   # of a box, mean diameters\nwalls:\n",
        diameter_, coupler::name_of_script(specification_.script), specification_.pressure,
        options_.seeds.size(), options_.height);
    for (std::size_t k = 0; k < walls.size(); ++k) {
      const double roughness = options_.roughnesses[k];
      std::string friction;
      std::string interval;
      std::string opening;
      const auto mean = mean_curve(walls[k]);
      for (std::size_t i = 0; i < mean.size(); ++i) {
        std::vector<double> values;
        for (const WallFigures& box : walls[k]) values.push_back(box.curve[i].friction);
        const double half = mean_and_interval(values).second;
        const char* const comma = i == 0 ? "" : ", ";
        friction += fmt::format("{}[{:.6g}, {:.4f}]", comma, mean[i].slip, mean[i].friction);
        interval += fmt::format("{}{:.4f}", comma, half);
        opening += fmt::format("{}[{:.6g}, {:.4g}]", comma, mean[i].slip, mean[i].opening);
        curves.row({fmt::format("{:g}", roughness), fmt::format("{:.4g}", mean[i].slip / diameter_),
                    fmt::format("{:.4f}", mean[i].friction), fmt::format("{:.4f}", half),
                    fmt::format("{:.4g}", mean[i].opening / diameter_)});
      }
      const auto note = [&](const char* key, Value value) {
        const auto [middle, half] = mean_of(walls[k], value);
        return fmt::format("    {}: [{:.4f}, {:.4f}]\n", key, middle, half);
      };
      const auto [turning, turning_half] = mean_of(walls[k], &WallFigures::turning);
      text += fmt::format(
          "  - roughness: {:g}\n    friction: [{}]   # slip in m, tan of the angle\n    friction_interval: [{}]\n    opening: "
          "[{}]   # slip in m, m\n    turning: {:.4f}   # of grains at the wall, rad per mean diameter of slip\n"
          "    turning_interval: {:.4f}\n{}{}",
          roughness, friction, interval, opening, turning, turning_half, note("peak", &WallFigures::peak),
          note("end", &WallFigures::end));
    }
    for (const int seed : options_.seeds) write_file(coupler::interface_file_of(packing_file(seed)), text);
    for (const std::filesystem::path& packing : options_.beside)
      write_file(coupler::interface_file_of(packing), text);
    if (!options_.quiet) show(walls);
    warn_of_unrest(walls);
  }

  /// Grains far from balance press and pull with their inertia, above all where they set out.
  void warn_of_unrest(const std::vector<std::vector<WallFigures>>& walls) const {
    constexpr double kUsual = 0.05;  // as `check` has it of unbalanced ratios
    double most = 0.0;
    for (const std::vector<WallFigures>& boxes : walls)
      most = std::max(most, mean_of(boxes, &WallFigures::unbalanced).first);
    if (most <= kUsual) return;
    tell(
        stderr,
        "warning: {}: the mean unbalanced ratio of the grains is {:.2g} (at most {:g} is usual): their inertia is in the "
        "friction, most of all where the slip begins; give a smaller --inertial-number than {:g} and another folder, 1e-3 is "
        "usual\n",
        options_.directory.string(), most, kUsual, options_.inertial_number);
  }

  void show(const std::vector<std::vector<WallFigures>>& walls) const {
    tell(stdout,
         "friction of grains on walls, mean and 95 % interval over {} boxes (slips in mean diameters):\n\n"
         "{:>10} {:>17} {:>6} {:>17} {:>8} {:>16} {:>14}\n",
         options_.seeds.size(), "roughness", "peak", "slip", "end", "rise", "turning, deg", "slip at wall");
    for (std::size_t k = 0; k < walls.size(); ++k) {
      const auto shown = [&](Value value, double scale, const char* form) {
        const auto [mean, half] = mean_of(walls[k], value);
        return fmt::format(fmt::runtime(form), scale * mean, scale * half);
      };
      tell(stdout, "{:>10g} {:>17} {:>6} {:>17} {:>8} {:>16} {:>14}\n", options_.roughnesses[k],
           shown(&WallFigures::peak, 1.0, "{:.3f} +- {:.3f}"), shown(&WallFigures::peak_at, 1.0, "{:.2f}"),
           shown(&WallFigures::end, 1.0, "{:.3f} +- {:.3f}"), shown(&WallFigures::rise, 1.0, "{:.2f}"),
           shown(&WallFigures::turning, 180.0 / std::numbers::pi, "{:.1f} +- {:.1f}"),
           shown(&WallFigures::share, 100.0, "{:.0f} %"));
    }
    tell(
        stdout,
        "\nslip: at the peak; end: the last diameter; turning: of grains at the wall, a diameter of slip; slip at wall: in "
        "its five diameters\n");
  }

  const InterfaceOptions& options_;
  const PackingTools& tools_;
  PackingSpecification specification_;
  LayerScript script_;
  Jobs jobs_;
  double diameter_ = 0.0;  ///< mean one of the grains, m
};

}  // namespace

int measure_interface(const InterfaceOptions& options, const PackingTools& tools) {
  note_interrupts();
  return WallMeasurement(options, tools).measure();
}

}  // namespace polargrain::app
