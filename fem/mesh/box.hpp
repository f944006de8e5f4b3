// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <string_view>

#include "fem/mesh/mesh.hpp"

namespace polargrain::fem {

/// [0, size_i] along each axis + origin, divided into equal elements. Boundaries left and right (x1), front and back (x2), bottom
/// and top (x3); node sets of the eight corners (bottom_front_left ...), of the twelve edges (bottom_front, bottom_left,
/// front_left ...), and all; region all.
struct BoxSpecification {
  std::array<double, 3> size;   ///< m, positive
  std::array<int, 3> elements;  ///< at least 1 each
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
};

/// @throws RunError when a size or a number of elements is not positive, or the element is unknown.
Mesh<3> box(const BoxSpecification& specification, std::string_view element = "H20R");

}  // namespace polargrain::fem
