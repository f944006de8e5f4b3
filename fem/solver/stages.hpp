// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <climits>
#include <string>
#include <vector>

#include "fem/mesh/mesh.hpp"

namespace polargrain::fem {

template <int dim>
struct Problem;
template <int dim>
struct BoundaryLoad;

/// The stages of construction that have a part of a problem: those from `begin` up to, not including, `end`.
struct Lifetime {
  int begin = 0;
  int end = INT_MAX;
  [[nodiscard]] bool holds(int stage) const { return begin <= stage && stage < end; }
  [[nodiscard]] bool is_whole() const { return begin == 0 && end == INT_MAX; }
  [[nodiscard]] bool overlaps(const Lifetime& other) const { return begin < other.end && other.begin < end; }
};

/// Whether each element is there in a stage: all of the regions it belongs to are. Empty where every element is.
template <int dim>
std::vector<char> elements_in_stage(const Problem<dim>& problem, int stage);

/// Nodes of the elements that are there. @param there as elements_in_stage has it
template <int dim>
std::vector<char> nodes_of_elements(const Mesh<dim>& mesh, const std::vector<char>& there);

/// The same, and the nodes of beams and rigid walls, which have no element at any time.
template <int dim>
std::vector<char> nodes_in_stage(const Mesh<dim>& mesh, const std::vector<char>& there);

/// The sides of its boundary that a load acts on in a stage: sides of elements that are there. Where a curve lies between two
/// regions, the side is that of the element left when the other one has gone. Inside of the body a load of the start acts
/// where the ground on both sides has stood since then; a load of a later stage where that ground never comes or goes, since
/// else it is one on a face that is yet to be dug.
template <int dim>
std::vector<BoundarySide> sides_in_stage(const Problem<dim>& problem, const BoundaryLoad<dim>& load,
                                         int stage);

/// The sides among `sides` that have an element on both of their sides: they have no outward normal.
/// @param there as elements_in_stage has it
template <int dim>
std::vector<BoundarySide> covered_sides(const Mesh<dim>& mesh, std::vector<BoundarySide> sides,
                                        const std::vector<char>& there);

}  // namespace polargrain::fem
