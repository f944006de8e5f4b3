// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/SparseCore>
#include <memory>
#include <string>

namespace polargrain::fem {

/// Direct solution of sparse systems without symmetry (UMFPACK). The symbolic analysis is made at the first
/// factorisation and used for all later ones, so every matrix must have the same pattern, or forget_pattern must be called.
class DirectSolver {
 public:
  DirectSolver();
  ~DirectSolver();
  DirectSolver(const DirectSolver&) = delete;
  DirectSolver& operator=(const DirectSolver&) = delete;

  void forget_pattern();
  /// @return false when the matrix is singular or has entries that are not finite, or when its factors do not fit into memory
  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& matrix);
  /// Of the matrix factorised last; 0: not known.
  [[nodiscard]] int sign_of_determinant() const;
  /// Why factorise has returned false.
  [[nodiscard]] const std::string& why_not() const;
  /// Solution with the matrix factorised last, which must still be alive and unchanged.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace polargrain::fem
