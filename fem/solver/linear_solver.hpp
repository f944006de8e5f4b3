// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/SparseCore>
#include <memory>

#include "fem/solver/coarse_space.hpp"

namespace polargrain::fem {

/// Unknowns from which iterations on two levels take the place of a direct solution, where the mesh has a coarse space.
inline constexpr int kDirectUnknowns = 30'000;

/// Solution of sparse systems without symmetry: directly, or for large systems in space by iterations (TwoLevelSolver). A matrix
/// whose iterations do not converge is solved directly. Every matrix must have the same pattern until change_pattern.
class LinearSolver {
 public:
  explicit LinearSolver(CoarseSpace space = {});
  ~LinearSolver();
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  /// Other unknowns from here on.
  void change_pattern(CoarseSpace space);
  /// @return false when the matrix is singular or has entries that are not finite.
  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& matrix);
  /// Solution with the matrix factorised last, which must still be alive and unchanged. NaN everywhere when iterations do not
  /// converge and the matrix turns out to be singular only then.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace polargrain::fem
