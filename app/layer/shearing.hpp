// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace polargrain::app {

/// A layer that was sheared, of grains or of elements, as both are compared. Lengths in m, rotations in rad.
struct Shearing {
  /// All places at one time.
  struct Frame {
    double displacement = 0.0;  ///< of the upper plate
    Eigen::VectorXd heights;
    Eigen::VectorXd along;  ///< displacements, or places, along the layer
    Eigen::VectorXd rotations;
  };
  std::vector<double> displacements;  ///< of the upper plate, growing
  std::vector<double> ratios;         ///< shear stress over the normal stress
  std::vector<Frame> frames;
};

/// How a layer yields and softens, in mean diameters d and shares of the normal stress. The way is that of the upper plate
/// past the peak, so that layers of any height have it in common.
struct LayerFigures {
  double peak = 0.0;       ///< largest ratio of the running mean over d/2
  double peak_at = 0.0;    ///< displacement there, d
  double halfway = 0.0;    ///< ratio over the peak, half of the way past it
  double end = 0.0;        ///< ratio over the peak, all of the way past it
  double thickness = 0.0;  ///< d; geometric mean over the second half of the way
  double growth = 0.0;     ///< of the thickness: its last value over its first there
  double turning =
      0.0;  ///< rotation in the band over displacement over thickness, -1/2 for one that turns with the continuum
  bool complete = false;  ///< whether it reached its end; otherwise the frames hold the part done

  /// Names and values, for tables.
  [[nodiscard]] std::vector<std::pair<std::string, double>> values() const;
};

/// @param diameter mean one of the grains, m @param way past the peak, in diameters
/// @throws RunError where it was not sheared by a diameter
LayerFigures figures_of(const Shearing& shearing, double diameter, double way);

}  // namespace polargrain::app
