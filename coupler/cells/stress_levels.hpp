// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "coupler/points/cell_point.hpp"

namespace polargrain::coupler {

/// The stresses that a box goes through in level ground from the surface downwards: vertical s, across K0 s, no shear.
struct GroundPath {
  element::Room room = element::Room::discs;
  int up = element::k22;  ///< Place of the vertical stress; k33 in bodies in space
  /// K0, horizontal over vertical stress; nothing: no strain across, and the stress there is what comes of it.
  std::optional<double> lateral_ratio = {};

  /// Whether the path gives the stress of a place; else it holds the strain there.
  [[nodiscard]] bool gives_stress(int place) const;
  /// Stresses under `vertical` (Pa, compression positive), tension positive; of the places that the path gives.
  [[nodiscard]] element::Vector6 stress(double vertical) const;
  /// Largest difference from it, Pa, over those places. @param found in the order of Place
  [[nodiscard]] double off(const element::Vector6& found, double vertical) const;
  /// The strains that lead a box there along its tangent. @param in_plane without those out of the plane of x1, x2
  [[nodiscard]] element::Vector6 strain_to(const CellResponse& box, double vertical, bool in_plane) const;
  /// Horizontal over vertical stress of a box: the mean of both directions where it tells both.
  [[nodiscard]] double ratio_of(const CellResponse& box) const;
};

/// Vertical stress of a box, Pa, compression positive.
double vertical_stress(const CellResponse& box, int up);

/// A packing at stresses along a path, a table from which boxes for any depth begin. Neighbours differ by less than a tenth.
struct StressLevels {
  std::vector<CellReply> boxes;  ///< by rising vertical stress
  std::string end_below;         ///< why it ends above the least stress asked for; mostly empty

  /// The one whose vertical stress has the ratio next to 1 to `vertical`.
  [[nodiscard]] std::size_t nearest(double vertical, int up) const;
};

/// Leads a packing at its vertical stress to the ratio of the path, then up, and from there down. Least and largest are vertical
/// stresses, Pa, compression positive. @throws RunError when it cannot be led to the ratio, or to the largest stress
StressLevels stress_levels(const AskCell& ask, const CellReply& packing, const GroundPath& path, double least,
                           double largest);

}  // namespace polargrain::coupler
