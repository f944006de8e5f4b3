// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

namespace polargrain::fem {

/// A point of a mesh in terms of the points of another one, for states that are taken over.
struct PointMean {
  std::size_t nearest = 0;
  /// Points and weights, which are 1 together; weights may be negative. A point at the same place stands alone, with 1.
  std::vector<std::pair<std::size_t, double>> parts;
};

/// How a material has taken the states of other points over (Material::take_over).
struct TakenOver {
  std::size_t from_nearest =
      0;  ///< points with the whole state of the nearest one, as boxes of grains need it
  /// Values that a mean would have given a sign that no point around has, such as a negative plastic shear; they are 0.
  std::size_t zeroed = 0;
};

}  // namespace polargrain::fem
