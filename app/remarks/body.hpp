// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <vector>

#include "fem/mesh/mesh.hpp"

namespace polargrain::app {

/// Sizes of a mesh, m.
struct Body {
  std::vector<double> elements;  ///< square root of the area of each, cube root of the volume in space
  double mean_element = 0.0;     ///< side of an element of the mean area or volume
  std::vector<double> sides;     ///< of the box around it, along each axis
  double bottom = 0.0;           ///< its lowest and highest point along the last axis
  double top = 0.0;

  [[nodiscard]] double height() const { return top - bottom; }
  [[nodiscard]] double smaller_side() const { return *std::ranges::min_element(sides); }
  [[nodiscard]] double larger_side() const { return *std::ranges::max_element(sides); }
};

template <int dim>
Body body_of(const fem::Mesh<dim>& mesh);

}  // namespace polargrain::app
