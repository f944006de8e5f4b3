// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <vector>

namespace polargrain::band {

/// Radius of the neighbourhood that the strain of a place is taken from, where nothing else is said, in mean distances.
inline constexpr double kNeighbourhood = 2.5;

/// Area that a place stands for, m^2: of the upright rectangle around all of them over their number, at least one.
double mean_area(const std::vector<Eigen::Vector2d>& positions);

/// Displacement gradients at scattered points (grains): at each the affine field that fits the displacements
/// of the points within `radius` best, weighted least squares with weights (1 - (d / radius)^2)^2. An affine
/// field is reproduced exactly. A strain that varies is smoothed over a width (full width at half maximum) of
/// about filter_width(radius).
/// @param positions, displacements m, of equal length
/// @param radius m; 2.5 mean distances of the points see about 20 neighbours
/// @returns a gradient a point, hij = d u_i / d x_j; not-a-number where a point has less than three
/// neighbours or they stand in one line
std::vector<Eigen::Matrix2d> displacement_gradients(const std::vector<Eigen::Vector2d>& positions,
                                                    const std::vector<Eigen::Vector2d>& displacements,
                                                    double radius);

/// Width over which displacement_gradients smooths: its kernel is that of the weights times the distance
/// squared integrated, proportional to (1 - (d / radius)^2)^3, of variance radius^2 / 10 an axis.
inline double filter_width(double radius) {
  return 2.3548 * 0.316228 * radius;
}

}  // namespace polargrain::band
