// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/SparseCore>

namespace polargrain::fem {

/// Factors by which rows and columns of a tangent are multiplied so that displacements and fields, whose units differ by many
/// powers of ten, weigh alike: 1 / sqrt of the diagonal for mechanics, and for fields of what the diagonal becomes when the
/// mechanics are eliminated by their diagonal. @param first_field first equation of a field; they come last
Eigen::VectorXd equation_scaling(const Eigen::SparseMatrix<double>& tangent, Eigen::Index first_field);

}  // namespace polargrain::fem
