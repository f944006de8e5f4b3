// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>

namespace polargrain::coupler {

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

/// Looks for the shear band of a result directory: prints what it is, writes band.json and band.csv there
/// (docs/file_formats.md). @returns 0, also when there is no band
/// @throws InputError when the directory does not hold what is needed
int band(const BandCommandOptions& options);

}  // namespace polargrain::coupler
