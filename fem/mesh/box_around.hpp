// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "fem/mesh/mesh.hpp"

namespace polargrain::fem {

/// The smallest box along the axes that holds some places, m.
template <int dim>
struct BoxAround {
  using Place = typename Cosserat<dim>::Place;
  Place least, largest;

  [[nodiscard]] Place sides() const { return largest - least; }
};

/// @param mesh with at least one node
template <int dim>
BoxAround<dim> box_around(const Mesh<dim>& mesh) {
  BoxAround<dim> box{mesh.nodes.front(), mesh.nodes.front()};
  for (const auto& node : mesh.nodes) {
    box.least = box.least.cwiseMin(node);
    box.largest = box.largest.cwiseMax(node);
  }
  return box;
}

}  // namespace polargrain::fem
