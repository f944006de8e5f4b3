// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <concepts>
#include <string_view>

#include "common/cosserat.hpp"

namespace polargrain::fem {

/// Unknowns of a node: displacements (m) along and micro-rotations (rad) about the axes. The plane has u1, u2 and w, the
/// rotation about e_3. A Cauchy continuum keeps the places of the rotations, which stay zero.
enum class Dof : int { u1 = 0, u2, u3, w1, w2, w3, w = w3 };

/// @returns whether it is a micro-rotation
[[nodiscard]] constexpr bool is_rotation(Dof dof) {
  return dof >= Dof::w1;
}

/// Axis that it is along or about, from 0.
[[nodiscard]] constexpr int axis_of(Dof dof) {
  return static_cast<int>(dof) % 3;
}

/// All unknowns of a node, in their order in nodal vectors.
template <int dim>
[[nodiscard]] constexpr auto node_dofs() {
  if constexpr (dim == 2) {
    return std::array{Dof::u1, Dof::u2, Dof::w};
  } else {
    return std::array{Dof::u1, Dof::u2, Dof::u3, Dof::w1, Dof::w2, Dof::w3};
  }
}

/// Place of an unknown among those of its node.
template <int dim>
[[nodiscard]] constexpr int place_of(Dof dof) {
  return dim == 2 && dof == Dof::w ? 2 : static_cast<int>(dof);
}

/// The unknown at an entry of a nodal vector.
template <int dim, std::integral Number>
[[nodiscard]] constexpr Dof dof_at(Number entry) {
  return node_dofs<dim>()[static_cast<std::size_t>(entry % Cosserat<dim>::dofs)];
}

/// "u1", "u2", "u3", "w1", "w2", "w3"; in the plane "w" for the last.
template <int dim>
[[nodiscard]] constexpr std::string_view name_of(Dof dof) {
  constexpr std::array<std::string_view, 6> names{"u1", "u2", "u3", "w1", "w2", "w3"};
  return dim == 2 && dof == Dof::w ? "w" : names[static_cast<std::size_t>(dof)];
}

/// Where a nodal vector keeps an unknown of a node; without one, where its unknowns begin. With the number of nodes of a
/// mesh: how long such a vector is. The same for the nodes of one element.
template <int dim, std::integral Number>
[[nodiscard]] constexpr Number entry_of(Number node, Dof dof = Dof::u1) {
  return Cosserat<dim>::dofs * node + static_cast<Number>(place_of<dim>(dof));
}

}  // namespace polargrain::fem
