// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "fem/solver/solver.hpp"

namespace polargrain::fem {

/// The rate of explicit steps that follows what they reach (docs/theory/explicit.md): slower at once where an error, or the
/// kinetic energy, is beyond its tolerance, faster little by little where there is room.
struct ExplicitRate {
  double error = 0.02;          ///< QuasiStatic::error that is allowed
  double kinetic_share = 0.05;  ///< the same of QuasiStatic::kinetic_share
  double aim = 0.7;             ///< share of the tolerances that is aimed at
  double most_slower = 0.5;     ///< factor of the speed from one row to the next
  double most_faster =
      1.25;  ///< factor of the speed in the time of a wave through the mesh, or in a row that is longer
  double slowest = 1.0 / 16.0;  ///< speed, of that at the start
  double fastest = 4.0;         ///< the same

  /// Speed of the next row. @param row the one behind, with its speed @param wave steps of a wave there and back; 0: not known
  [[nodiscard]] double next_speed(const StepReport& row, int wave) const;
};

}  // namespace polargrain::fem
