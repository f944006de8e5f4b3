// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/commands/band.hpp"

#include <fmt/format.h>
#include <memory>

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "app/commands/command.hpp"
#include "app/commands/csv_file.hpp"
#include "app/run/json_text.hpp"
#include "band/displacement_field.hpp"
#include "band/frames.hpp"
#include "band/shear_band.hpp"
#include "band/space_fields.hpp"
#include "common/error.hpp"
#include "common/plain_text.hpp"
#include "common/standard_streams.hpp"
#include "coupler/case/quantity.hpp"
#include "fem/output/write_file.hpp"

namespace polargrain::app {
namespace {

using polargrain::band::Band;
using polargrain::band::BandSearch;
using polargrain::band::DisplacementField;
using polargrain::band::FieldIncrement;
using polargrain::band::FrameKind;
using polargrain::band::Frames;
using polargrain::band::Sample;
using polargrain::band::Samples;

constexpr double kDegree = std::numbers::pi / 180.0;

/// A length of the command line, m.
double positive_length(const std::string& option, const std::string& text) {
  const std::optional<double> length = coupler::parse_quantity(text, coupler::Dimension::length);
  if (!length || *length <= 0.0)
    throw InputError({"", 0,
                      fmt::format("{} {}: {} above 0 was expected", option, plain_text(text),
                                  expectation(coupler::Dimension::length))});
  return *length;
}

/// The parts of a name that ends in a number, such as step-00012: the text before it, and the number. Other names give nothing.
std::optional<std::pair<std::string, long>> numbered(const std::filesystem::path& file) {
  const std::string name = file.stem().string();
  const std::size_t place = name.find_last_not_of("0123456789") + 1;
  long number = 0;
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + place, end, number);
  if (place == name.size() || error != std::errc{} || stop != end) return std::nullopt;
  return std::pair{name.substr(0, place), number};
}

/// Two fields of one series of images: exchanged, they give every strain the wrong sign.
/// @throws InputError where the first is the later one
void check_order(const std::filesystem::path& from, const std::filesystem::path& to) {
  const auto first = numbered(from);
  const auto last = numbered(to);
  if (!first || !last || first->first != last->first || from.parent_path() != to.parent_path() ||
      first->second <= last->second)
    return;
  throw InputError(
      {from.string(), 0,
       fmt::format("by its number this field is later than {0}, and all strains would change their sign; "
                   "name the earlier one first: polargrain band {0} {1}",
                   plain_text(to.string()), plain_text(from.string()))});
}

/// A body of this size is rare among those whose images are compared; in mm or pixels all are larger, m.
constexpr double kLargeBody = 10.0;

/// Lengths in mm or pixels, printed as m, look right.
void tell_unit(const BandMeasurement& measured, const BandCommandOptions& options) {
  if (measured.kind != FrameKind::images || options.has_unit || measured.extent <= kLargeBody) return;
  tell(
      stderr,
      "warning: the places span {:.4g} m, as 1 in the fields counts as 1 m: give the length of 1 with --unit, such as "
      "--unit 1mm\n",
      measured.extent);
}

/// The increments between frames a window apart, and how each deforms.
struct Increments {
  std::vector<double> strains;  ///< middle of each
  std::vector<double> localisations;
};

void write_samples(const std::filesystem::path& file, const Samples& samples) {
  std::string text = "x,y,area,shear,volume_strain,rotation\n";
  for (const Sample& sample : samples)
    text +=
        fmt::format("{:.7g},{:.7g},{:.5g},{:.5g},{:.5g},{:.5g}\n", sample.position.x(), sample.position.y(),
                    sample.area, sample.shear, sample.volume_strain, sample.rotation);
  fem::write_file(file, text);
}

/// The larger side of the rectangle around all places, m.
double extent_of(const Samples& samples) {
  Eigen::AlignedBox2d box;
  for (const Sample& sample : samples) box.extend(sample.position);
  return samples.empty() ? 0.0 : box.sizes().maxCoeff();
}

/// The measures of an increment, without those of its frames.
BandMeasurement measured_in(const Samples& samples, const BandCommandOptions& options) {
  if (!options.fields.empty()) write_samples(options.fields, samples);
  BandMeasurement measured;
  measured.places = samples.size();
  measured.extent = extent_of(samples);
  measured.search = find_band(samples, {options.contrast});
  if (const std::optional<Band>& found = measured.search.band) {
    measured.rotation = means(samples, *found, &Sample::rotation);
    measured.volume_strain = means(samples, *found, &Sample::volume_strain);
  }
  return measured;
}

/// Localisation of all increments in the band found last, and the band that each has by itself, into
/// band.csv.
Increments follow(const Frames& frames, const BandCommandOptions& options, const Band& last) {
  Increments increments;
  CsvFile table(options.places.front() / "band.csv", {"axial_strain", "localisation", "inclination_degrees",
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

void write_summary(const std::filesystem::path& file, const BandMeasurement& measured) {
  const auto or_null = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
  };
  nlohmann::ordered_json summary{{"from", or_null(measured.begin)},
                                 {"to", or_null(measured.end)},
                                 {"found", measured.search.band.has_value()}};
  if (measured.kind == FrameKind::images) summary["missing"] = measured.missing;
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
    summary["onset_strain"] = or_null(measured.onset);
  } else {
    summary["reason"] = measured.search.reason;
  }
  fem::write_file(file, json_text(summary));
}

}  // namespace

std::vector<std::size_t> frames_apart(const Frames& frames, double window) {
  std::vector<std::size_t> chosen{0};
  const std::vector<double>& strains = frames.axial_strains();
  for (std::size_t k = 1; k < strains.size(); ++k)
    if (strains[k] - strains[chosen.back()] > (1.0 - 1e-6) * window) chosen.push_back(k);
  return chosen;
}

std::pair<std::size_t, std::size_t> increment_of(const Frames& frames, const BandCommandOptions& options) {
  const double last_strain = frames.axial_strains().back();
  const std::size_t to = frames.nearest(options.to >= 0.0 ? options.to : last_strain);
  const std::size_t from = frames.nearest(options.from >= 0.0 ? options.from : 2.0 / 3.0 * last_strain);
  if (from > to)
    throw InputError({"", 0,
                      fmt::format("--from {} lies behind --to {}: the increment would end before it begins",
                                  frames.axial_strains()[from], frames.axial_strains()[to])});
  if (from == to)
    throw InputError({"", 0,
                      fmt::format("--from {} and --to {} are one frame; the frames go from {:.4g} to {:.4g}",
                                  options.from, options.to, frames.axial_strains().front(), last_strain)});
  return {from, to};
}

BandMeasurement measure_band(const BandCommandOptions& options) {
  const std::filesystem::path& directory = options.places.front();
  const Frames frames(directory, options.strain_column, options.units, options.neighbourhood);
  const auto [from, to] = increment_of(frames, options);
  BandMeasurement measured = measured_in(frames.increment(from, to, options.current), options);
  measured.begin = frames.axial_strains()[from];
  measured.end = frames.axial_strains()[to];
  measured.kind = frames.kind();
  measured.missing = frames.missing(from, to);
  if (measured.search.band) {
    const Increments increments = follow(frames, options, *measured.search.band);
    measured.onset = polargrain::band::onset_strain(increments.strains, increments.localisations);
  }
  write_summary(directory / "band.json", measured);
  return measured;
}

BandMeasurement measure_band_of_fields(const BandCommandOptions& options) {
  const std::filesystem::path& last = options.places.back();
  if (options.places.size() > 1) check_order(options.places.front(), last);
  std::optional<DisplacementField> first;
  if (options.places.size() > 1) first = read_displacement_field(options.places.front(), options.units);
  const FieldIncrement increment =
      increment_between(first ? &*first : nullptr, read_displacement_field(last, options.units));
  if (increment.positions.empty())
    throw InputError(
        {last.string(), 0,
         first ? "no place has a displacement here and in the other field: both must have the same "
                 "columns x and y, places of one reference image"
               : "no place has a displacement"});
  BandMeasurement measured;
  try {
    measured = measured_in(samples_of(increment, options.neighbourhood, options.current), options);
  } catch (const std::invalid_argument& error) {
    throw InputError({last.string(), 0, error.what()});
  }
  measured.kind = FrameKind::images;
  measured.missing = increment.missing;
  write_summary(last.parent_path() / (last.stem().string() + ".band.json"), measured);
  return measured;
}

namespace {

/// The fields of image correlation of a result directory. One of a run has no such fields.
std::vector<std::filesystem::path> displacement_files(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> files;
  for (const auto& [step, file] : polargrain::band::frame_files(directory / "displacements", ".csv"))
    files.push_back(file);
  return files;
}

}  // namespace

int band(const BandCommandOptions& options) {
  const bool of_fields = std::ranges::none_of(options.places, [](const std::filesystem::path& place) {
    std::error_code error;  // links that lead round in circles are no directory either
    return std::filesystem::is_directory(place, error);
  });
  if (!of_fields && options.places.size() > 1)
    throw InputError({options.places.back().string(), 0,
                      "one result directory was expected, or one or two CSV files of displacements"});
  // A name that ends otherwise is meant as a directory, which does not exist.
  const bool is_csv = of_fields && options.places.front().extension() == ".csv";
  constexpr const char* kBeginning = "x,y,area,";
  if (is_csv) {
    check_table("--fields", options.fields, options.places, kBeginning);
  } else {
    check_beside_run("--fields", options.fields, options.places.front());
    const Frames frames(options.places.front(), options.strain_column, options.units, options.neighbourhood);
    const bool in_space =
        frames.kind() == FrameKind::elements && polargrain::band::is_of_space(frames.file(0));
    check_table("--fields", options.fields, displacement_files(options.places.front()),
                in_space ? "x,y,z,volume," : kBeginning);
    if (in_space) return band_in_space(frames, options);
  }
  const BandMeasurement measured = is_csv ? measure_band_of_fields(options) : measure_band(options);
  tell_unit(measured, options);
  constexpr const char* kPlaces[] = {"integration points", "grains", "places of the images"};
  std::string where = options.places.front().string();
  if (measured.begin) {
    where += fmt::format(": increment of axial strain {:.4f} to {:.4f}", *measured.begin, *measured.end);
  } else if (options.places.size() > 1) {
    where += fmt::format(" to {}", options.places.back().string());
  }
  tell(stdout, "{}, {} {}{}\n", where, measured.places, kPlaces[static_cast<int>(measured.kind)],
       measured.missing > 0 ? fmt::format("; {} without a displacement are left out", measured.missing) : "");
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
       "  rotation      {:.4f} rad inside, {:.4f} rad outside\n",
       found.inclination / kDegree, found.thickness, found.resolution, found.peak, found.background,
       measured.volume_strain.inside, measured.volume_strain.outside, measured.rotation.inside,
       measured.rotation.outside);
  if (measured.begin)
    tell(stdout, "  onset         {}\n",
         measured.onset ? fmt::format("axial strain {:.4f}", *measured.onset)
                        : "not within the increments: the last is not localised");
  return 0;
}

Command add_band(CLI::App& program, const Grains&) {
  const auto options = std::make_shared<BandCommandOptions>();
  const auto lengths = std::make_shared<std::pair<std::string, std::string>>();
  CLI::App& command =
      *program.add_subcommand("band", "Measure the shear band of a result: inclination, thickness, onset");
  command
      .add_option(
          "DIR", options->places,
          "Results of run, of a specimen made of grains, or of image correlation (displacements/step-*.csv, "
          "history.csv); or FIELD.csv, an increment of image correlation; or FROM.csv TO.csv, the increment "
          "between two fields (columns x, y, u, v)")
      ->required()
      ->expected(1, 2);
  command.add_option("--from", options->from, "Axial strain where the increment begins [2/3 of the last]")
      ->check(finite_number());
  command.add_option("--to", options->to, "Axial strain where it ends [the last]")->check(finite_number());
  command.add_option("--window", options->window, "Axial strain of the increments for the onset [0.005]")
      ->check(CLI::PositiveNumber)
      ->check(finite_number());
  command.add_option("--contrast", options->contrast, "Least shear of a band over the background [2]")
      ->check(CLI::Range(1.0, 1e9))
      ->check(finite_number());
  command.add_option("--strain", options->strain_column, "Column of history.csv with the axial strain")
      ->type_name("COLUMN")
      ->capture_default_str();
  command.add_flag("--current", options->current, "Measure where places are at --from, not at the start");
  command
      .add_option("--unit", lengths->first,
                  "Length of 1 in fields of images, such as 0.08mm: of a pixel [1 m]")
      ->type_name("LENGTH");
  command.add_flag("--y-down", options->units.y_down, "y and v of fields of images point down");
  command
      .add_option(
          "--neighbourhood", lengths->second,
          "Radius that the strain of a grain or of a place of an image is taken from [2.5 mean distances]")
      ->type_name("LENGTH");
  command.add_option("--fields", options->fields, "Write the samples of the increment as CSV")
      ->type_name("FILE");
  return {&command, [options, lengths] {
            options->has_unit = !lengths->first.empty();
            if (options->has_unit) options->units.length = positive_length("--unit", lengths->first);
            if (!lengths->second.empty())
              options->neighbourhood = positive_length("--neighbourhood", lengths->second);
            return band(*options);
          }};
}

}  // namespace polargrain::app
