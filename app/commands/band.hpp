// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "band/frames.hpp"
#include "band/shear_band.hpp"

namespace polargrain::app {

struct BandCommandOptions {
  /// A result directory (of a run, of a specimen made of grains, of image correlation), or one or two fields of image
  /// correlation (CSV).
  std::vector<std::filesystem::path> places;
  std::string strain_column = "axial_strain";  ///< of history.csv
  double from = -1.0;                          ///< axial strain; negative: two thirds of the last
  double to = -1.0;                            ///< negative: the last
  double window = 0.005;                       ///< of the increments that the onset is looked for in
  double contrast = 2.0;                       ///< least peak over background of a band
  bool current = false;                        ///< positions at the start of the increment, not of the test
  polargrain::band::FieldUnits units = {};     ///< of fields of image correlation
  bool has_unit = false;                       ///< the user has given the length of 1 in these fields
  double neighbourhood = 0.0;         ///< radius that strains are taken from, m; 0: 2.5 mean distances
  std::filesystem::path fields = {};  ///< CSV of the samples of the increment; empty: not written
};

/// The measures of a band.
struct BandMeasurement {
  std::optional<double> begin;  ///< axial strain of the frame the increment begins with; empty for fields
  std::optional<double> end;    ///< and ends with
  std::size_t places = 0;
  std::size_t missing = 0;  ///< places of images without a displacement
  double extent = 0.0;      ///< larger side of the rectangle around the places, m
  polargrain::band::FrameKind kind = polargrain::band::FrameKind::elements;
  polargrain::band::BandSearch search = {};
  std::optional<double>
      onset;  ///< axial strain; empty without a band, for fields, or where the last increment has no band
  polargrain::band::InsideOutside rotation = {};       ///< with a band
  polargrain::band::InsideOutside volume_strain = {};  ///< with a band
};

/// Looks for the shear band of a result directory and writes band.json and band.csv there
/// (docs/file_formats.md). @throws InputError when the directory does not hold what is needed
BandMeasurement measure_band(const BandCommandOptions& options);

/// Looks for the band of one field of image correlation, or of the increment between two, and writes band.json beside the
/// last, NAME.band.json. @throws InputError as read_displacement_field
BandMeasurement measure_band_of_fields(const BandCommandOptions& options);

/// Frames, from the first, each farther than a window of axial strain from the last.
std::vector<std::size_t> frames_apart(const polargrain::band::Frames& frames, double window);

/// First and last frame of the increment that the options name. @throws InputError where they are one
std::pair<std::size_t, std::size_t> increment_of(const polargrain::band::Frames& frames,
                                                 const BandCommandOptions& options);

/// Looks for the plane of a result in space, writes band.json and band.csv as measure_band does, and prints what it found.
int band_in_space(const polargrain::band::Frames& frames, const BandCommandOptions& options);

/// One of the first two, or the last, and prints what it found. @returns 0, also when there is no band
/// @throws InputError as these
int band(const BandCommandOptions& options);

}  // namespace polargrain::app
