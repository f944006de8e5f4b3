// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace polargrain::dem {

/// The engine tells contact models of an opened contact between grains only as long as the gap is below this
/// factor of the sum of radii, and by default (factor 1) never: the stock springs of a contact that opens and
/// closes again between two builds of the neighbour list go on where they were. Models that must forget ask
/// for this factor. Grains do not part by one per cent of their size in a step.
inline constexpr double kClosingFactor = 1.01;

}  // namespace polargrain::dem
