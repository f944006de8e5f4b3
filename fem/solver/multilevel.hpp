// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

#include "fem/solver/coarse_space.hpp"
#include "fem/solver/direct_solver.hpp"
#include "fem/solver/group_smoother.hpp"

namespace polargrain::fem {

/// Iterations on levels for large systems in space: GMRES, preconditioned by a cycle over levels. Quadratic elements give the
/// second level their corners; further ones are made by aggregation until a direct solution is cheap. Each level smooths by
/// a sweep of Gauss-Seidel over its nodes, before its coarse solution and, backwards, behind it. Nothing of it asks for
/// symmetry. Same matrix: same bits.
class MultilevelSolver {
 public:
  /// @param space not empty; must outlive this object
  /// @param direct_unknowns up to which a coarse level is solved directly
  MultilevelSolver(const CoarseSpace& space, int direct_unknowns);

  /// @return false when the coarsest level, or a node, is singular
  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& matrix);
  /// Nothing when the iterations do not converge to a relative residual of 1e-10, forces and moments weighed by the diagonal.
  [[nodiscard]] std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& right_side);
  /// Of the last solution.
  [[nodiscard]] int iterations() const { return iterations_; }
  /// Unknowns of each level of the matrix factorised last, finest first.
  [[nodiscard]] std::vector<int> unknowns_of_levels() const;

 private:
  using Matrix = GroupSmoother::Matrix;
  struct Level {
    Matrix matrix;            ///< with a diagonal of +-1
    std::vector<int> begins;  ///< of its groups
    GroupSmoother smoother;
    Matrix prolongation;  ///< from the next level
  };
  [[nodiscard]] Eigen::VectorXd cycle(std::size_t level, const Eigen::VectorXd& right_side) const;
  /// Lets the prolongation of the last level make the matrix of the next one, and scales that.
  [[nodiscard]] bool coarsen(UnknownGroups& groups);

  const CoarseSpace& space_;
  int direct_unknowns_;
  std::vector<Level> levels_;
  Eigen::VectorXd scale_;  ///< 1 / sqrt(|diagonal|) of the finest level
  Eigen::SparseMatrix<double> coarsest_matrix_;
  DirectSolver coarsest_;
  int iterations_ = 0;
};

}  // namespace polargrain::fem
