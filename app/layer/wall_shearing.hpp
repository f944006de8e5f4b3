// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/layer/shearing.hpp"
#include "fem/interface/friction_curve.hpp"

namespace polargrain::app {

/// Grains that were sheared on a rough wall. Lengths in m.
struct WallShearing {
  Shearing layer;  ///< its ratios are shear over normal stress of the wall; frames without the wall's grains
  std::vector<double> rises;       ///< of the plate, at layer.displacements
  std::vector<double> unbalanced;  ///< forces over contact forces, at the same
  double wall = 0.0;               ///< height of the wall's surface
};

/// The result of shear_between on a wall. @param surface height of the wall's surface, m @throws InputError naming file and line
WallShearing read_wall_shearing(const std::filesystem::path& folder, double pressure, double surface);

/// One box on a wall, in mean diameters d. Its slip is the displacement of the plate: the box is the interface.
struct WallFigures {
  double peak = 0.0;     ///< largest friction of the running mean over d/2
  double peak_at = 0.0;  ///< slip there, d
  double end = 0.0;      ///< mean friction over the last diameter
  double rise = 0.0;     ///< of the plate at the end, d
  double turning =
      0.0;  ///< of grains at the wall past the peak, rad per d of slip, positive where they roll along the wall
  double share = 0.0;       ///< of the slip past the peak that the five diameters at the wall take
  double unbalanced = 0.0;  ///< mean over all of the slip; no column of tables
  std::vector<fem::FrictionCurve::Measured> curve;  ///< at slips_of_curve, slip and opening in m

  /// Names and values, for tables.
  [[nodiscard]] std::vector<std::pair<std::string, double>> values() const;
};

/// Slips that friction is told at, in d: close where it rises, each half a diameter later, up to the way.
std::vector<double> slips_of_curve(double way);

/// @param diameter mean one of the grains, m @param way slip up to which figures are taken, d
/// @throws RunError where it was not sheared by two diameters, or not as far
WallFigures wall_figures(const WallShearing& shearing, double diameter, double way);

/// The means of boxes on walls of one roughness, at the same slips.
std::vector<fem::FrictionCurve::Measured> mean_curve(const std::vector<WallFigures>& boxes);

}  // namespace polargrain::app
