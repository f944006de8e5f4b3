// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/SparseCore>

#include "fem/solver/coarse_space.hpp"
#include "fem/solver/group_smoother.hpp"

namespace polargrain::fem {

/// A coarser level: groups of neighbouring groups that move like rigid bodies, smoothed.
struct Aggregation {
  Eigen::SparseMatrix<double, Eigen::RowMajor> prolongation;
  UnknownGroups groups;  ///< of its columns
};

/// Smoothed aggregation (Vanek, Mandel and Brezina 1996): each aggregate is a group with its strong neighbours, its unknowns
/// are the motions of `groups` restricted to it, made orthonormal; one damped step of Jacobi's iteration by groups smooths
/// them.
/// @param matrix with a diagonal of +-1
Aggregation aggregate(const Eigen::SparseMatrix<double, Eigen::RowMajor>& matrix, const UnknownGroups& groups,
                      const GroupSmoother& smoother);

}  // namespace polargrain::fem
