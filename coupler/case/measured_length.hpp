// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "common/error.hpp"

namespace polargrain::coupler {

/// The lengths that `polargrain layer` has found for the grains of a packing under a script, kept beside the packing in
/// PACKING.length.yaml and read where a case says `lc: measured` or `spread: measured` (docs/file_formats.md).
struct MeasuredLength {
  double internal_length = 0.0;          ///< lc, m
  std::optional<double> plastic_length;  ///< lp, m; nothing: the couple stress has no limit
  std::optional<double> spread;          ///< of slips, m; nothing: it was not sought
  double mean_diameter = 0.0;            ///< of the grains, m
  std::string script;                    ///< name_of_script of the contact law
};

/// NAME.length.yaml beside NAME.h5
std::filesystem::path length_file_of(const std::filesystem::path& packing);

/// A name for the commands of a script, whatever its comments, spaces and files: the same for equal contact laws written alike.
std::string name_of_script(const std::string& text);

/// @throws InputError with all faults of the file, their lines, and the remedy
MeasuredLength read_measured_length(const std::filesystem::path& file);

/// The grains that lengths are asked for.
struct GrainsToMeasure {
  std::filesystem::path packing;
  std::string name;            ///< of the packing, as the case has it
  double mean_diameter = 0.0;  ///< m
  std::string script;          ///< text of the contact law; empty: it has a fault
  std::string script_name;
};
/// The lengths beside a packing. @returns nothing, and tells `fault` why, where the file is missing, wrong, of other grains or another law
std::optional<MeasuredLength> length_beside(const GrainsToMeasure& grains,
                                            const std::function<void(const std::string&)>& fault);

}  // namespace polargrain::coupler
