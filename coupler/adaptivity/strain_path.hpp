// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <vector>

#include "coupler/adaptivity/grain_measure.hpp"

namespace polargrain::coupler {

/// The places where a path of increments, which begins at zero, turns: those that no straight piece between their
/// neighbours comes closer to than `tolerance` (GrainMeasure::place; Ramer 1972, Douglas and Peucker 1973).
/// The last place is always among them; alone when the path is straight.
std::vector<Increment> turning_points(std::span<const Increment> path, const GrainMeasure& measure,
                                      double tolerance);

}  // namespace polargrain::coupler
