// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/commands/band.hpp"

#include <fmt/format.h>
#include <memory>

#include <algorithm>
#include <numbers>
#include <optional>

#include "app/commands/command.hpp"
#include "app/commands/csv_file.hpp"
#include "app/run/json_text.hpp"
#include "band/frames.hpp"
#include "band/shear_band.hpp"
#include "common/error.hpp"
#include "common/standard_streams.hpp"
#include "fem/output/write_file.hpp"

namespace polargrain::app {
namespace {

using polargrain::band::Band;
using polargrain::band::BandSearch;
using polargrain::band::Frames;
using polargrain::band::Sample;
using polargrain::band::Samples;

constexpr double kDegree = std::numbers::pi / 180.0;

/// The increments between frames a window apart, and how each deforms.
struct Increments {
  std::vector<double> strains;  ///< middle of each
  std::vector<double> localisations;
};

std::vector<std::size_t> frames_apart(const Frames& frames, double window) {
  std::vector<std::size_t> chosen{0};
  const std::vector<double>& strains = frames.axial_strains();
  for (std::size_t k = 1; k < strains.size(); ++k)
    if (strains[k] - strains[chosen.back()] > (1.0 - 1e-6) * window) chosen.push_back(k);
  return chosen;
}

/// Localisation of all increments in the band found last, and the band that each has by itself, into
/// band.csv.
Increments follow(const Frames& frames, const BandCommandOptions& options, const Band& last) {
  Increments increments;
  CsvFile table(options.directory / "band.csv", {"axial_strain", "localisation", "inclination_degrees",
                                                 "thickness", "rotation_inside", "rotation_outside"});
  const std::vector<std::size_t> chosen = frames_apart(frames, options.window);
  for (std::size_t k = 1; k < chosen.size(); ++k) {
    const Samples samples = frames.increment(chosen[k - 1], chosen[k], options.current);
    const double strain = 0.5 * (frames.axial_strains()[chosen[k - 1]] + frames.axial_strains()[chosen[k]]);
    increments.strains.push_back(strain);
    increments.localisations.push_back(polargrain::band::localisation(samples, last));
    const BandSearch own = find_band(samples, {options.contrast});
    const auto rotation = means(samples, last, &Sample::rotation);
    table.row({exact(strain), exact(increments.localisations.back()),
               own.band ? exact(own.band->inclination / kDegree) : "",
               own.band ? exact(own.band->thickness) : "", exact(rotation.inside), exact(rotation.outside)});
  }
  return increments;
}

void write_samples(const std::filesystem::path& file, const Samples& samples) {
  std::string text = "x,y,area,shear,volume_strain,rotation\n";
  for (const Sample& sample : samples)
    text +=
        fmt::format("{:.7g},{:.7g},{:.5g},{:.5g},{:.5g},{:.5g}\n", sample.position.x(), sample.position.y(),
                    sample.area, sample.shear, sample.volume_strain, sample.rotation);
  fem::write_file(file, text);
}

void write_summary(const std::filesystem::path& file, const BandMeasurement& measured) {
  nlohmann::ordered_json summary{
      {"from", measured.begin}, {"to", measured.end}, {"found", measured.search.band.has_value()}};
  if (const std::optional<Band>& found = measured.search.band) {
    summary["inclination_degrees"] = found->inclination / kDegree;
    summary["thickness"] = found->thickness;
    summary["resolution"] = found->resolution;
    summary["centre"] = {found->centre.x(), found->centre.y()};
    summary["peak_shear"] = found->peak;
    summary["background_shear"] = found->background;
    summary["rotation_inside"] = measured.rotation.inside;
    summary["rotation_outside"] = measured.rotation.outside;
    summary["volume_strain_inside"] = measured.volume_strain.inside;
    summary["volume_strain_outside"] = measured.volume_strain.outside;
    summary["onset_strain"] = measured.onset ? nlohmann::ordered_json(*measured.onset) : nullptr;
  } else {
    summary["reason"] = measured.search.reason;
  }
  fem::write_file(file, json_text(summary));
}

}  // namespace

BandMeasurement measure_band(const BandCommandOptions& options) {
  const Frames frames(options.directory, options.strain_column);
  const double last_strain = frames.axial_strains().back();
  const std::size_t to = frames.nearest(options.to >= 0.0 ? options.to : last_strain);
  const std::size_t from = frames.nearest(options.from >= 0.0 ? options.from : 2.0 / 3.0 * last_strain);
  if (from >= to)
    throw InputError({"", 0,
                      fmt::format("--from {} and --to {} are one frame; the frames go from {:.4g} to {:.4g}",
                                  options.from, options.to, frames.axial_strains().front(), last_strain)});
  const Samples samples = frames.increment(from, to, options.current);
  if (!options.fields.empty()) write_samples(options.fields, samples);
  BandMeasurement measured{frames.axial_strains()[from],
                           frames.axial_strains()[to],
                           samples.size(),
                           frames.of_grains(),
                           find_band(samples, {options.contrast}),
                           {},
                           {},
                           {}};
  if (measured.search.band) {
    const Band& found = *measured.search.band;
    const Increments increments = follow(frames, options, found);
    measured.onset = polargrain::band::onset_strain(increments.strains, increments.localisations);
    measured.rotation = means(samples, found, &Sample::rotation);
    measured.volume_strain = means(samples, found, &Sample::volume_strain);
  }
  write_summary(options.directory / "band.json", measured);
  return measured;
}

int band(const BandCommandOptions& options) {
  const BandMeasurement measured = measure_band(options);
  tell(stdout, "{}: increment of axial strain {:.4f} to {:.4f}, {} {}\n", options.directory.string(),
       measured.begin, measured.end, measured.places, measured.of_grains ? "grains" : "integration points");
  if (!measured.search.band) {
    tell(stdout, "  no band: {}\n", measured.search.reason);
    return 0;
  }
  const Band& found = *measured.search.band;
  tell(stdout,
       "  inclination   {:.1f} degrees from the horizontal\n"
       "  thickness     {:.4g} m at half maximum (resolution {:.2g} m)\n"
       "  shear strain  {:.4f} at its greatest, {:.4f} in the background\n"
       "  volume strain {:.4f} inside, {:.4f} outside\n"
       "  rotation      {:.4f} rad inside, {:.4f} rad outside\n"
       "  onset         {}\n",
       found.inclination / kDegree, found.thickness, found.resolution, found.peak, found.background,
       measured.volume_strain.inside, measured.volume_strain.outside, measured.rotation.inside,
       measured.rotation.outside,
       measured.onset ? fmt::format("axial strain {:.4f}", *measured.onset)
                      : "not within the increments: the last is not localised");
  return 0;
}

Command add_band(CLI::App& program, const Grains&) {
  const auto options = std::make_shared<BandCommandOptions>();
  CLI::App& command =
      *program.add_subcommand("band", "Measure the shear band of a result: inclination, thickness, onset");
  command.add_option("DIR", options->directory, "Results of run, or of a specimen made of grains")
      ->required();
  command.add_option("--from", options->from, "Axial strain where the increment begins [2/3 of the last]");
  command.add_option("--to", options->to, "Axial strain where it ends [the last]");
  command.add_option("--window", options->window, "Axial strain of the increments for the onset [0.005]")
      ->check(CLI::PositiveNumber);
  command.add_option("--contrast", options->contrast, "Least shear of a band over the background [2]")
      ->check(CLI::Range(1.0, 1e9));
  command.add_option("--strain", options->strain_column, "Column of history.csv with the axial strain")
      ->type_name("COLUMN")
      ->capture_default_str();
  command.add_flag("--current", options->current, "Measure where places are at --from, not at the start");
  command.add_option("--fields", options->fields, "Write the samples of the increment as CSV")
      ->type_name("FILE");
  return {&command, [options] { return band(*options); }};
}

}  // namespace polargrain::app
