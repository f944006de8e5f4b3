// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

namespace polargrain::fem {

/// Gauss-Seidel iterations over groups of unknowns, each group solved together. The order is that of the groups, so sums have
/// the same bits every time.
class GroupSmoother {
 public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  /// Inverts the diagonal block of each group. @returns false when one of them is singular
  [[nodiscard]] bool learn(const Matrix& matrix, const std::vector<int>& begins);

  /// One sweep for matrix * x = right_side over the groups, from the first to the last or back. Arguments are those of learn.
  void sweep(const Matrix& matrix, const std::vector<int>& begins, const Eigen::VectorXd& right_side,
             bool forwards, Eigen::VectorXd& x) const;

  /// The inverse of a group's diagonal block, over its unknowns.
  [[nodiscard]] Eigen::Map<const Eigen::MatrixXd> inverse(const std::vector<int>& begins,
                                                          std::size_t group) const {
    const int size = begins[group + 1] - begins[group];
    return {inverses_.data() + places_[group], size, size};
  }

 private:
  std::vector<double> inverses_;     ///< one after the other, by columns
  std::vector<std::size_t> places_;  ///< of each inverse
  int largest_ = 0;                  ///< unknowns of a group
};

}  // namespace polargrain::fem
