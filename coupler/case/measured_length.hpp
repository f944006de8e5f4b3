// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "common/error.hpp"

namespace polargrain::coupler {

/// The lengths that `polargrain layer` has found for the grains of a packing under a script, kept beside the packing in
/// PACKING.length.yaml and read where a case says `lc: measured` (docs/file_formats.md).
struct MeasuredLength {
  double internal_length = 0.0;          ///< lc, m
  std::optional<double> plastic_length;  ///< lp, m; nothing: the couple stress has no limit
  double mean_diameter = 0.0;            ///< of the grains, m
  std::string script;                    ///< name_of_script of the contact law
};

/// NAME.length.yaml beside NAME.h5
std::filesystem::path length_file_of(const std::filesystem::path& packing);

/// A name for the commands of a script, whatever its comments, spaces and files: the same for equal contact laws written alike.
std::string name_of_script(const std::string& text);

/// @throws InputError with all faults of the file, their lines, and the remedy
MeasuredLength read_measured_length(const std::filesystem::path& file);

}  // namespace polargrain::coupler
