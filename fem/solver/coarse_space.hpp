// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/SparseCore>
#include <vector>

#include "fem/mesh/mesh.hpp"
#include "fem/solver/constraints.hpp"

namespace polargrain::fem {

/// The unknowns that carry the smooth part of a solution, for iterations on two levels: those of the corners of quadratic
/// elements. Fields linear along edges are fields of the mesh too, so the coarse problem is a Galerkin one.
struct CoarseSpace {
  /// A row an unknown, a column a coarse unknown: 1 at corners, 1/2 for each end of an edge at its middle node. No columns:
  /// the mesh offers no coarse space.
  Eigen::SparseMatrix<double> prolongation;
  /// First unknown of each node, and behind the last one the number of all: unknowns of a node are smoothed together.
  std::vector<int> node_begins;
};

/// Empty in the plane, and where fewer than half of the unknowns belong to middle nodes.
template <int dim>
CoarseSpace coarse_space(const Mesh<dim>& mesh, const Constraints<dim>& constraints);

}  // namespace polargrain::fem
