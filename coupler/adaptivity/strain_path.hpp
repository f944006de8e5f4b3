// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

namespace polargrain::coupler {

/// The places where a path of displacement gradients, which begins at zero, turns: those that no straight
/// piece between their neighbours comes closer to than `tolerance` (Ramer 1972, Douglas and Peucker 1973).
/// The last place is always among them; alone when the path is straight.
std::vector<Eigen::Matrix2d> turning_points(std::span<const Eigen::Matrix2d> path, double tolerance);

}  // namespace polargrain::coupler
