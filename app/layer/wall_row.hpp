// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/packing.hpp"

namespace polargrain::app {

/// Grains on a rough wall.
struct OnWall {
  Packing grains;       ///< the wall's have the largest ids
  double wall = 0.0;    ///< height of the centres of the wall's grains, m: no other grain is as low
  double top = 0.0;     ///< height up to which there are grains, m
  double radius = 0.0;  ///< of the wall's grains, m
};

/// A periodic packing of discs, opened above and below, over a row of equal grains that touch each other and as many as fit into the
/// width: a wall of that roughness. The row lies as high as it can without an overlap. Its grains have the mean mass of the others,
/// or more, so that small ones do not shorten the time step.
/// @param diameter of the wall's grains, m; theirs differs from it so that they fill the width
/// @param height over which grains are kept, m @throws RunError when a row has less than three grains, or nothing lies above it
OnWall on_wall(const Packing& packing, double diameter, double height);

}  // namespace polargrain::app
