// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "common/packing.hpp"

namespace polargrain {

/// How far apart grains are kept in the engine's lists of neighbours (`neighbor DISTANCE bin` of a script), m: a fifth of
/// their mean radius, as the nearest of 1, 2 and 5 times a power of ten. Less rebuilds the lists more often, more keeps
/// pairs that never touch. Round, so that packings of one sort of grains have one order of their sums, and so the same bits.
/// @returns a decimal number, as scripts take it
std::string neighbour_distance(const Packing& packing);

}  // namespace polargrain
