// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <vector>

namespace polargrain::dem {

/// A disc of a specimen.
struct Disc {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< m
  double radius = 0.0;                               ///< m
};

enum class Side { left, right };

/// The grains that a flexible membrane rests on, from the bottom platen to the top one: those that a probe
/// disc touches which comes from the outside along the bottom platen and rolls upwards over the grains until
/// it meets the top platen. The probe is the membrane's stiffness: no gap that it cannot enter is entered.
/// @param probe radius of the probe disc, m; two of the largest grains' radii do not fall between grains
/// @param bottom, top height of the platens' faces, m
/// @returns indices into `discs`, bottom first. Equal discs give equal chains.
/// @throws std::runtime_error when no grain lies next to the bottom platen, or the probe comes into the
/// specimen
std::vector<std::size_t> membrane_chain(const std::vector<Disc>& discs, double probe, double bottom,
                                        double top, Side side);

/// Forces of a uniform pressure on a chain: the pressure on each link between neighbouring centres, half to
/// either end; on the straight ends between the outer centres and the platens, all of it to the one grain.
/// Their sum is pressure * thickness * (top - bottom) across, and pressure * thickness * (shift of the chain
/// from its lower to its upper end) along.
/// @param centres of the chain's grains, bottom first
/// @param line_pressure pressure * thickness, N/m
/// @returns a force a grain, N
std::vector<Eigen::Vector2d> membrane_forces(const std::vector<Eigen::Vector2d>& centres,
                                             double line_pressure, double bottom, double top, Side side);

/// Area between the centre lines of two chains and the platens, m^2. Its variation is the work of
/// membrane_forces() and of the platens: the stress of a specimen refers to it.
double enclosed_area(const std::vector<Eigen::Vector2d>& left, const std::vector<Eigen::Vector2d>& right,
                     double bottom, double top);

}  // namespace polargrain::dem
