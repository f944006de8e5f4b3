// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "coupler/case/document.hpp"
#include "fem/interface/friction_curve.hpp"

namespace polargrain::coupler {

/// Friction of the grains of a packing on a wall of one roughness.
struct MeasuredWall {
  double roughness = 0.0;  ///< diameter of the wall's grains over the mean diameter of the others
  std::vector<fem::FrictionCurve::Measured> curve;
  /// Rotation of the grains at the wall over the slip, rad per mean diameter: positive where they roll along the wall.
  double turning = 0.0;
  double mean_diameter = 0.0;  ///< of the grains, m
};

/// Friction that `polargrain interface` has measured on boxes of the grains of a packing under a script. It is kept beside the packing in
/// PACKING.interface.yaml and read where a case says `friction: measured` (docs/file_formats.md).
struct MeasuredInterface {
  double mean_diameter = 0.0;  ///< of the grains, m
  std::string script;          ///< name_of_script of the contact law
  std::vector<MeasuredWall> walls;

  /// The wall of a roughness; null where it was not measured.
  [[nodiscard]] const MeasuredWall* wall(double roughness) const;
};

/// Texts of a key of all materials that have a packing, or of those with one packing alone where it is given. @param materials of a
/// case, null for a case without any
std::set<std::string> of_materials_with_packing(const Entry* materials, const std::string& key,
                                                const std::string& packing = {});

/// The packing that `friction: measured` of an interface means, as it is written: its own, or the only one of the materials; empty
/// where that packing does not exist.
std::string packing_of_interface(const Entry& interface, const Entry* materials);

/// NAME.interface.yaml beside NAME.h5
std::filesystem::path interface_file_of(const std::filesystem::path& packing);

/// @throws InputError with all faults of the file, their lines, and the remedy
MeasuredInterface read_measured_interface(const std::filesystem::path& file);

}  // namespace polargrain::coupler
