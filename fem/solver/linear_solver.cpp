// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/linear_solver.hpp"

#include <limits>
#include <optional>

#include "fem/solver/direct_solver.hpp"
#include "fem/solver/two_level.hpp"

namespace polargrain::fem {

struct LinearSolver::Implementation {
  explicit Implementation(CoarseSpace of_mesh) : space(std::move(of_mesh)) {
    if (space.prolongation.cols() > 0 && space.prolongation.rows() > kDirectUnknowns)
      two_level.emplace(space);
  }

  CoarseSpace space;
  std::optional<TwoLevelSolver> two_level;
  DirectSolver direct;
  Eigen::SparseMatrix<double> kept;  ///< the matrix whose iterations did not converge
  // Of the matrix factorised last, and of no other: a run that goes on from a checkpoint has the same bits.
  bool is_direct = true;
};

LinearSolver::LinearSolver(CoarseSpace space)
    : implementation_(std::make_unique<Implementation>(std::move(space))) {}

LinearSolver::~LinearSolver() = default;

void LinearSolver::change_pattern(CoarseSpace space) {
  implementation_ = std::make_unique<Implementation>(std::move(space));
}

bool LinearSolver::factorise(const Eigen::SparseMatrix<double>& matrix) {
  if (matrix.rows() == 0) return true;
  auto& [space, two_level, direct, kept, is_direct] = *implementation_;
  if (!Eigen::Map<const Eigen::VectorXd>(matrix.valuePtr(), matrix.nonZeros()).allFinite()) return false;
  is_direct = !two_level || !two_level->factorise(matrix);
  return !is_direct || direct.factorise(matrix);
}

Eigen::VectorXd LinearSolver::solve(const Eigen::VectorXd& right_side) const {
  auto& [space, two_level, direct, kept, is_direct] = *implementation_;
  if (is_direct) return direct.solve(right_side);
  if (std::optional<Eigen::VectorXd> solution = two_level->solve(right_side)) return *std::move(solution);
  is_direct = true;
  kept = two_level->matrix();
  if (direct.factorise(kept)) return direct.solve(right_side);
  return Eigen::VectorXd::Constant(right_side.size(), std::numeric_limits<double>::quiet_NaN());
}

}  // namespace polargrain::fem
