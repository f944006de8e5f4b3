// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <string_view>
#include <vector>

#include "fem/mesh/mesh.hpp"

namespace polargrain::fem {

/// [0, size0] x [0, size1] + origin, divided into equal elements. Boundaries left, right, bottom, top; node
/// sets bottom_left, bottom_right, top_right, top_left and all; region all.
struct RectangleSpecification {
  std::array<double, 2> size;   ///< m, positive
  std::array<int, 2> elements;  ///< at least 1 each
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
};

/// @throws RunError when a size or a number of elements is not positive, or the element is unknown.
Mesh<2> rectangle(const RectangleSpecification& specification, std::string_view element = "Q8R");

/// Elements whose centres lie between two corners or on the sides there.
/// @param low the lower left one
std::vector<int> elements_between(const Mesh<2>& mesh, const Eigen::Vector2d& low,
                                  const Eigen::Vector2d& high);

}  // namespace polargrain::fem
