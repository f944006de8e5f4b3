// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <memory>
#include <optional>
#include <vector>

#include "fem/solver/coarse_space.hpp"
#include "fem/solver/direct_solver.hpp"

namespace polargrain::fem {

/// Iterations on two levels for large systems of quadratic elements: GMRES (Saad and Schultz 1986), preconditioned by a sweep
/// of block Gauss-Seidel over the nodes, a direct solution of the Galerkin problem of the corners, and a sweep back. One thread
/// and a fixed order of sums: the same bits every time.
class TwoLevelSolver {
 public:
  /// @param space with columns; must outlive this object
  explicit TwoLevelSolver(const CoarseSpace& space) : space_(space) {}

  /// @return false when the problem of the corners, or that of a node, is singular
  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& matrix);
  /// To a relative residual of 1e-10, with unknowns scaled by the diagonal; nothing when `most_iterations` do not lead there.
  [[nodiscard]] std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& right_side);
  /// The matrix factorised last.
  [[nodiscard]] const Eigen::SparseMatrix<double, Eigen::RowMajor>& matrix() const { return matrix_; }
  /// Of the last solution.
  [[nodiscard]] int iterations() const { return iterations_; }

 private:
  [[nodiscard]] Eigen::VectorXd precondition(const Eigen::VectorXd& residual) const;
  /// Gauss-Seidel over the nodes, from the first to the last or back.
  void sweep(const Eigen::VectorXd& right_side, bool forwards, Eigen::VectorXd& x) const;

  const CoarseSpace& space_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix_;
  Eigen::VectorXd scale_;  ///< 1 / sqrt(|diagonal|)
  std::vector<Eigen::MatrixXd> node_inverses_;
  DirectSolver coarse_;
  Eigen::SparseMatrix<double> coarse_matrix_;
  int iterations_ = 0;
};

}  // namespace polargrain::fem
