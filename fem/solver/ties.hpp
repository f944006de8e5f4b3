// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "fem/mesh/mesh.hpp"

namespace polargrain::fem {

/// Two opposite boundaries that move alike, node by node, in all unknowns: the field between them repeats sideways
/// without end (a layer as wide as one element, a periodic block).
struct Tie {
  std::string on;  ///< boundary or node set whose nodes follow
  std::string to;  ///< the boundary or node set they follow: the same nodes, moved by one translation
};

/// A tie on a mesh.
struct TiedNodes {
  std::vector<std::pair<int, int>> pairs;  ///< (node that follows, node it follows)
  std::string fault;                       ///< why the two do not match; empty when they do
};

/// Finds for each node on `tie.on` its partner on `tie.to`. The translation is that of the two centroids; partners lie
/// within 1e-6 of its length.
template <int dim>
TiedNodes tied_nodes(const Mesh<dim>& mesh, const Tie& tie);

}  // namespace polargrain::fem
