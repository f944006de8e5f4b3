// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

namespace polargrain {

/// Eigenvalues of a symmetric matrix, ascending, and their eigenvectors as columns.
struct SymmetricModes {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// @param matrix symmetric; its lower half counts. Compiled here alone: a decomposition of Eigen costs each file that holds one
/// ten seconds.
SymmetricModes symmetric_modes(const Eigen::MatrixXd& matrix);
/// The values alone, with the same bits.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

}  // namespace polargrain
