// SPDX-License-Identifier: GPL-2.0-or-later
// `band` of a body in space: a plane.
#include <fmt/format.h>

#include <numbers>

#include "app/commands/band.hpp"
#include "app/commands/csv_file.hpp"
#include "app/run/json_text.hpp"
#include "band/space_fields.hpp"
#include "common/standard_streams.hpp"
#include "fem/output/write_file.hpp"

namespace polargrain::app {
namespace {

using polargrain::band::InsideOutside;
using polargrain::band::Plane;
using polargrain::band::PlaneSearch;
using polargrain::band::space_increment;
using polargrain::band::SpaceSample;
using polargrain::band::SpaceSamples;

constexpr double kOneDegree = std::numbers::pi / 180.0;

void write_samples(const std::filesystem::path& file, const SpaceSamples& samples) {
  std::string text = "x,y,z,volume,shear,volume_strain,w1,w2,w3\n";
  for (const SpaceSample& sample : samples)
    text +=
        fmt::format("{:.7g},{:.7g},{:.7g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g}\n", sample.position.x(),
                    sample.position.y(), sample.position.z(), sample.volume, sample.shear,
                    sample.volume_strain, sample.rotation.x(), sample.rotation.y(), sample.rotation.z());
  fem::write_file(file, text);
}

/// Onset: localisation of all increments in the plane found last, and the plane that each has by itself, into band.csv.
std::optional<double> follow(const polargrain::band::Frames& frames, const BandCommandOptions& options,
                             const Plane& last) {
  std::vector<double> strains;
  std::vector<double> localisations;
  CsvFile table(options.places.front() / "band.csv",
                {"axial_strain", "localisation", "dip_degrees", "dip_direction_degrees", "thickness"});
  const std::vector<std::size_t> chosen = frames_apart(frames, options.window);
  for (std::size_t k = 1; k < chosen.size(); ++k) {
    const SpaceSamples samples =
        space_increment(frames.file(chosen[k - 1]), frames.file(chosen[k]), options.current);
    strains.push_back(0.5 * (frames.axial_strains()[chosen[k - 1]] + frames.axial_strains()[chosen[k]]));
    localisations.push_back(polargrain::band::localisation(samples, last));
    const PlaneSearch own = find_plane(samples, {options.contrast});
    table.row({exact(strains.back()), exact(localisations.back()),
               own.plane ? exact(own.plane->dip() / kOneDegree) : "",
               own.plane ? exact(own.plane->dip_direction() / kOneDegree) : "",
               own.plane ? exact(own.plane->thickness) : ""});
  }
  return polargrain::band::onset_strain(strains, localisations);
}

}  // namespace

int band_in_space(const polargrain::band::Frames& frames, const BandCommandOptions& options) {
  const auto [from, to] = increment_of(frames, options);
  const double begin = frames.axial_strains()[from];
  const double end = frames.axial_strains()[to];
  const SpaceSamples samples = space_increment(frames.file(from), frames.file(to), options.current);
  if (!options.fields.empty()) write_samples(options.fields, samples);
  const PlaneSearch search = find_plane(samples, {options.contrast});
  nlohmann::ordered_json summary{{"from", begin}, {"to", end}, {"found", search.plane.has_value()}};
  tell(stdout, "{}: increment of axial strain {:.4f} to {:.4f}, {} integration points in space\n",
       options.places.front().string(), begin, end, samples.size());
  if (search.plane) {
    const Plane& found = *search.plane;
    const InsideOutside dilation = means(samples, found, &SpaceSample::volume_strain);
    const std::optional<double> onset = follow(frames, options, found);
    summary["dip_degrees"] = found.dip() / kOneDegree;
    summary["dip_direction_degrees"] = found.dip_direction() / kOneDegree;
    summary["normal"] = {found.normal.x(), found.normal.y(), found.normal.z()};
    summary["thickness"] = found.thickness;
    summary["resolution"] = found.resolution;
    summary["centre"] = {found.centre.x(), found.centre.y(), found.centre.z()};
    summary["peak_shear"] = found.peak;
    summary["background_shear"] = found.background;
    summary["volume_strain_inside"] = dilation.inside;
    summary["volume_strain_outside"] = dilation.outside;
    summary["onset_strain"] = onset ? nlohmann::ordered_json(*onset) : nlohmann::ordered_json(nullptr);
    tell(stdout,
         "  plane         dips by {:.1f} degrees, towards {:.1f} degrees from x1 to x2\n"
         "  thickness     {:.4g} m at half maximum (resolution {:.2g} m)\n"
         "  shear strain  {:.4f} at its greatest, {:.4f} in the background\n"
         "  volume strain {:.4f} inside, {:.4f} outside\n"
         "  onset         {}\n",
         found.dip() / kOneDegree, found.dip_direction() / kOneDegree, found.thickness, found.resolution,
         found.peak, found.background, dilation.inside, dilation.outside,
         onset ? fmt::format("axial strain {:.4f}", *onset)
               : "not within the increments: the last is not localised");
  } else {
    summary["reason"] = search.reason;
    tell(stdout, "  no band: {}\n", search.reason);
  }
  fem::write_file(options.places.front() / "band.json", json_text(summary));
  return 0;
}

}  // namespace polargrain::app
