// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "common/packing.hpp"
#include "common/packing_specification.hpp"

namespace polargrain::dem {

/// Grains that do not touch, at random places of a square (in dimension 3: cubic) periodic box: the loose
/// start of a packing. Determined by the size law, the number of grains and the seed.
/// @throws RunError when there is no room for a grain (sizes too different).
Packing place_grains(const PackingSpecification& specification);

/// The same for grains that are to fall (deposit()): in a box as wide as a cube of the packing's own grains will be about, high
/// enough for some layers more, which stay on the floor and on top. No grain reaches through floor or top.
Packing place_rain(const PackingSpecification& specification);

/// How many of the grains that have fallen lie below those that are kept.
std::size_t grains_below(std::size_t fallen, std::size_t kept);

}  // namespace polargrain::dem
