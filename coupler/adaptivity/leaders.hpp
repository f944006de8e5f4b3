// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <functional>
#include <vector>

namespace polargrain::coupler {

/// Few leaders for many points: every point ends covered by one. Takes the point that covers most others,
/// then the one that covers most of the rest, and so on; ties go to the point named first.
/// @param points their numbers @param covers whether a cell that follows the first would do for the second; a
/// point always covers itself @returns leaders, in the order they were chosen. Asks `covers` at most 500
/// times the number of points in a round; more points than that take their leaders from an even choice.
std::vector<std::size_t> choose_leaders(const std::vector<std::size_t>& points,
                                        const std::function<bool(std::size_t, std::size_t)>& covers);

}  // namespace polargrain::coupler
