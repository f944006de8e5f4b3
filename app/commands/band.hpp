// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "band/shear_band.hpp"

namespace polargrain::app {

struct BandCommandOptions {
  std::filesystem::path directory;             ///< of a run, or of a specimen made of grains
  std::string strain_column = "axial_strain";  ///< of history.csv
  double from = -1.0;                          ///< axial strain; negative: two thirds of the last
  double to = -1.0;                            ///< negative: the last
  double window = 0.005;                       ///< of the increments that the onset is looked for in
  double contrast = 2.0;                       ///< least peak over background of a band
  bool current = false;                        ///< positions at the start of the increment, not of the test
  std::filesystem::path fields;                ///< CSV of the samples of the increment; empty: none
};

/// What there is to say of the band of a result directory.
struct BandMeasurement {
  double begin = 0.0;  ///< axial strain of the frame the increment begins with
  double end = 0.0;    ///< and ends with
  std::size_t places = 0;
  bool of_grains = false;
  polargrain::band::BandSearch search;
  std::optional<double> onset;  ///< axial strain; none without a band, or where the last increment is none
  polargrain::band::InsideOutside rotation;       ///< with a band
  polargrain::band::InsideOutside volume_strain;  ///< with a band
};

/// Looks for the shear band of a result directory and writes band.json and band.csv there
/// (docs/file_formats.md). @throws InputError when the directory does not hold what is needed
BandMeasurement measure_band(const BandCommandOptions& options);

/// measure_band, and prints what it found. @returns 0, also when there is no band
/// @throws InputError as measure_band
int band(const BandCommandOptions& options);

}  // namespace polargrain::app
