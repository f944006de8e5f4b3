// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>

#include "common/packing_specification.hpp"
#include "dem/pack/pressed_box.hpp"

namespace polargrain::dem {

/// Lets grains fall along -x2 onto a floor, under an acceleration with which the bed weighs on the floor as much as the
/// specification asks of x2, until they rest. The middle of the bed, without the layer ordered by the floor and without
/// its surface, becomes a packing that is periodic in x2 too: cut along two planes, the upper one laid under the lower one, shifted
/// along x1, with cut and shift where the seam is closest. Its box is not narrower than the bed was; nothing overlaps at the seam.
/// @param rain the grains to fall (place_rain)
/// @throws RunError when the grains are not at rest within the steps allowed
Packing deposit(const PackingSpecification& specification, const Packing& rain,
                const MakingFriction& friction, const std::function<void(const PackingReached&)>& progress);

/// The `count` grains of a bed whose lowest is the one with `first` below it, closed as deposit() does; they are numbered
/// anew, from the lowest on.
Packing cut_from_bed(const Packing& bed, std::size_t first, std::size_t count);

/// The packing turned about x3, its state with it. @param angle counter-clockwise, rad
PreparedPacking turned(PreparedPacking packing, double angle);

}  // namespace polargrain::dem
