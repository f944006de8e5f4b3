// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/SparseCore>
#include <memory>
#include <string>

#include "fem/solver/coarse_space.hpp"

namespace polargrain::fem {

/// Unknowns from which iterations take the place of a direct solution, where the mesh has a coarse space.
inline constexpr int kDirectUnknowns = 25'000;

/// Solution of sparse systems without symmetry: directly (DirectSolver), or for large systems in space by iterations
/// (MultilevelSolver). A matrix whose iterations do not converge is solved directly, as those after it are until begin_step.
/// Every matrix must have the same pattern until change_pattern.
class LinearSolver {
 public:
  explicit LinearSolver(CoarseSpace space = {}, int direct_unknowns = kDirectUnknowns);
  ~LinearSolver();
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  /// Other unknowns from here on.
  void change_pattern(CoarseSpace space);
  /// Iterations may be tried again: a run that goes on from a checkpoint has the same bits.
  void begin_step();
  /// @return false when the matrix is singular or has entries that are not finite, or when its iterations do not converge and
  /// a direct solution needs more memory than the machine has (see news)
  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& matrix);
  /// Solution with the matrix factorised last, which must still be alive and unchanged. NaN everywhere when iterations do not
  /// converge and a direct solution fails, as above.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;

  /// Of the matrix factorised last; 0: not known, as of iterations.
  [[nodiscard]] int sign_of_determinant() const;
  /// For a log, since the last call: which solver is at work and why. Empty when nothing has changed.
  [[nodiscard]] std::string news();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace polargrain::fem
