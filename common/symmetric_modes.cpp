// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/symmetric_modes.hpp"

#include <Eigen/Eigenvalues>

namespace polargrain {
namespace {

using Solver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

}  // namespace

SymmetricModes symmetric_modes(const Eigen::MatrixXd& matrix) {
  const Solver solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix) {
  return Solver(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace polargrain
