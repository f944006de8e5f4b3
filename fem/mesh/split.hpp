// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fem/mesh/mesh.hpp"

namespace polargrain::fem {

/// A face of a curve (in space: a surface) of the mesh, from both its sides. Node lists of its sides have one order.
template <int dim>
struct TwoSidedFace {
  const ElementType<dim - 1>* type;
  BoundarySide first;                  ///< side a; the normal points out of its element
  std::optional<BoundarySide> second;  ///< side b; nothing on the outer boundary
  std::vector<int> first_nodes;        ///< global numbers, in the order of the element's side
  std::vector<int> second_nodes;       ///< those at the same places, in the same order; empty without side b

  /// The same face seen from side b. Needs one.
  [[nodiscard]] TwoSidedFace seen_from_second(const Mesh<dim>& mesh) const;
};

/// The faces of a boundary, or of a node set that holds all nodes of whole faces. Neighbours have their first side on
/// the same side, where ground is all along; in the plane they follow each other along the curve, from where it begins.
/// @throws RunError when nothing has that name, it holds no face, or there is no such side
template <int dim>
std::vector<TwoSidedFace<dim>> faces_along(const Mesh<dim>& mesh, const std::string& name);

/// Parts the mesh along faces: a node gets a copy for each further group of elements around it that the faces part from the
/// others. So an end inside of the body stays one node, an end on the outer boundary becomes two, and where curves meet
/// there is one copy a sector. Boundaries keep all copies, as they refer to elements; node sets get the copies added.
/// @param faces from faces_along, of all curves at once; their node lists are brought up to date
template <int dim>
void split_along(Mesh<dim>& mesh, std::vector<std::vector<TwoSidedFace<dim>>>& faces);

/// Nodes of a body that has no elements of the mesh: a wall of beams, a rigid wall.
template <int dim>
struct OwnNodes {
  std::vector<int> nodes;                    ///< new numbers, in the order of the faces
  std::vector<std::vector<int>> face_nodes;  ///< of each face, in the order of its first side
};

/// Adds a node of its own at the place of each node of the faces, before or after split_along.
/// @param originals the faces as they were before split_along, which says what nodes are at one place
template <int dim>
OwnNodes<dim> add_own_nodes(Mesh<dim>& mesh, const std::vector<TwoSidedFace<dim>>& originals);
/// The same for bodies that are one where they meet. @param own_of own nodes of those before, by original node: taken over, added to
template <int dim>
OwnNodes<dim> add_own_nodes(Mesh<dim>& mesh, const std::vector<TwoSidedFace<dim>>& originals,
                            std::map<int, int>& own_of);

}  // namespace polargrain::fem
