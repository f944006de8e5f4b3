// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <concepts>

namespace polargrain::fem {

/// Unknowns of a node, in their order in nodal vectors: displacements (m), micro-rotation (rad). A Cauchy continuum
/// keeps the place of the last one, which stays zero.
enum class Dof : int { u1 = 0, u2 = 1, w = 2 };

inline constexpr int kDofsOfNode = 3;

/// Where a nodal vector keeps an unknown of a node; without one, where its three begin. With the number of nodes of a
/// mesh: how long such a vector is. The same for the nodes of one element.
template <std::integral Number>
[[nodiscard]] constexpr Number entry_of(Number node, Dof dof = Dof::u1) {
  return kDofsOfNode * node + static_cast<Number>(dof);
}

}  // namespace polargrain::fem
