// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/SparseCore>
#include <vector>

#include "fem/solver/constraints.hpp"
#include "fem/solver/discretisation.hpp"
#include "fem/solver/loads.hpp"

namespace polargrain::fem {

/// The sparse tangent of the unknowns. Its pattern is found once; where each element's entries go is
/// remembered, so that assembling is additions only.
template <int dim>
class TangentMatrix {
 public:
  /// Both must outlive this object.
  TangentMatrix(const Discretisation<dim>& discretisation, const Constraints<dim>& constraints);

  /// To be called when other elements are there or other entries are given: finds the pattern anew.
  void renew();

  /// Overwrites the values by those of the tangents of the points, less those of the loads.
  const Eigen::SparseMatrix<double>& assemble(const Linearisation<dim>& of,
                                              const std::vector<LoadStiffness>& loads);

 private:
  void find_pattern();
  void find_places();
  [[nodiscard]] int place_of(int row, int column) const;

  const Discretisation<dim>& discretisation_;
  const Constraints<dim>& constraints_;
  std::vector<std::vector<int>> equations_;  ///< of each element's unknowns, -1 where given
  Eigen::SparseMatrix<double> matrix_;
  std::vector<int> places_;  ///< in the values of the matrix, for the free entries of each element in turn
};

}  // namespace polargrain::fem
