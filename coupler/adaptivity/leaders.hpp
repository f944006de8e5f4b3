// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <functional>
#include <vector>

#include "common/increment.hpp"

namespace polargrain::coupler {

/// Few leaders for many points: every point ends covered by one. Takes the point that covers most others,
/// then the one that covers most of the rest, and so on; ties go to the point named first.
/// @param points their numbers @param covers whether a cell that follows the first would do for the second; a
/// point always covers itself @returns leaders, in the order they were chosen. Asks `covers` at most 500
/// times the number of points in a round; more points than that take their leaders from an even choice.
std::vector<std::size_t> choose_leaders(const std::vector<std::size_t>& points,
                                        const std::function<bool(std::size_t, std::size_t)>& covers);

/// Points whose strains span the directions that occur, for the first runs of a cell of which nothing is known: the
/// largest strain, and then the largest one that is more than 60 degrees from all that were chosen, at most six.
/// @param points not empty @param strain of a point (GrainMeasure::strain) @param least norm of strains that show more than
/// noise; smaller ones are passed over, but for the largest
template <int dim>
std::vector<std::size_t> span_directions(
    const std::vector<std::size_t>& points,
    const std::function<typename Cosserat<dim>::Vector(std::size_t)>& strain, double least);

}  // namespace polargrain::coupler
