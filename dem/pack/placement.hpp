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

}  // namespace polargrain::dem
