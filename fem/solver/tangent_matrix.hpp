// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "fem/solver/constraints.hpp"
#include "fem/solver/contribution.hpp"
#include "fem/solver/discretisation.hpp"
#include "fem/solver/loads.hpp"

namespace polargrain::fem {

/// The sparse tangent of the unknowns, contributions included. Its pattern is found once; where each element's entries go is
/// remembered, so that assembling is additions only.
template <int dim>
class TangentMatrix {
 public:
  using ContributionList = std::vector<std::shared_ptr<Contribution<dim>>>;

  /// All must outlive this object.
  TangentMatrix(const Discretisation<dim>& discretisation, const Constraints<dim>& constraints,
                const ContributionList& contributions);

  /// Overwrites the values by those of the tangents of the points and of the contributions, less those of the loads.
  const Eigen::SparseMatrix<double>& assemble(const Linearisation<dim>& of,
                                              const std::vector<LoadStiffness>& loads);

 private:
  void find_pattern();
  void find_places();
  [[nodiscard]] int place_of(int row, int column) const;
  /// Adds the tangent of an element at the places that follow.
  void add(const Eigen::MatrixXd& local, const std::vector<int>& equations,
           std::vector<int>::const_iterator& place);

  const Discretisation<dim>& discretisation_;
  const Constraints<dim>& constraints_;
  const ContributionList& contributions_;
  /// Of each element's unknowns, -1 where given; of the mesh, then of each contribution.
  std::vector<std::vector<int>> equations_;
  Eigen::SparseMatrix<double> matrix_;
  std::vector<int> places_;  ///< in the values of the matrix, for the free entries of each element in turn
};

}  // namespace polargrain::fem
