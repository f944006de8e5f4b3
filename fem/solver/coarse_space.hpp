// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/SparseCore>
#include <vector>

#include "fem/mesh/mesh.hpp"
#include "fem/solver/constraints.hpp"

namespace polargrain::fem {

/// Unknowns in groups, and the fields of them that strain nothing: all that aggregation asks for.
struct UnknownGroups {
  /// First unknown of each group, and behind the last group the number of unknowns. Unknowns of a group, those of a node,
  /// are smoothed together.
  std::vector<int> begins;
  /// Rigid motions, a column each, a row an unknown: three translations and three rotations, micro-rotations with them.
  Eigen::MatrixXd motions;

  [[nodiscard]] int unknowns() const { return begins.empty() ? 0 : begins.back(); }
  [[nodiscard]] std::size_t count() const { return begins.empty() ? 0 : begins.size() - 1; }
};

/// The knowledge of a mesh that iterations on levels (MultilevelSolver) need.
struct CoarseSpace {
  UnknownGroups groups;  ///< of all unknowns; without groups the mesh has no coarse space
  /// Quadratic elements: a row an unknown, a column an unknown of a corner: 1 at corners, 1/2 for each end of an edge at its
  /// middle node. Fields linear along edges are fields of the mesh too. Without columns where it would save too little.
  Eigen::SparseMatrix<double, Eigen::RowMajor> from_corners;
  UnknownGroups corners;  ///< the groups of its columns

  [[nodiscard]] bool is_empty() const { return groups.count() == 0; }
};

/// Empty in the plane, and where unknowns are there besides those of the nodes (pore pressures).
template <int dim>
CoarseSpace coarse_space(const Mesh<dim>& mesh, const Constraints<dim>& constraints);

}  // namespace polargrain::fem
