// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/SparseCore>
#include <functional>
#include <string>
#include <vector>

#include "fem/solver/constraints.hpp"
#include "fem/solver/contribution.hpp"
#include "fem/solver/direct_solver.hpp"
#include "fem/solver/problem.hpp"

namespace polargrain::fem {

/// Places of an element's entries in its own matrices.
struct PartsOfElement {
  std::vector<Eigen::Index> mechanics;
  std::vector<Eigen::Index> fields;
};

/// @param mechanics number of the entries of displacements and micro-rotations (FieldPlaces::mechanics)
PartsOfElement parts_of_element(const std::vector<int>& entries, Eigen::Index mechanics);

/// -d rows / d fields of all contributions, of their last evaluation, over the unknowns of the fields alone.
template <int dim>
Eigen::SparseMatrix<double> matrix_of_fields(const Problem<dim>& problem,
                                             const Constraints<dim>& constraints);

/// Balances the rows of the fields over an explicit step, whose displacements are known, where the rows are linear in parts: slips
/// that go on at some nodes and rest at others. Most steps change no part, and the factors of an earlier step serve.
template <int dim>
class FieldBalance {
 public:
  /// Evaluates the contributions at an increment. @returns why one of them cannot; empty: the forces are there
  using Evaluate = std::function<std::string(const Eigen::VectorXd& increment)>;

  /// @param forces which `evaluate` fills @param increment of the step, in: given entries and displacements, out: fields too
  /// @returns why it cannot; empty: balanced to the tolerances of the fields
  [[nodiscard]] std::string balance(const Problem<dim>& problem, const Constraints<dim>& constraints,
                                    const Evaluate& evaluate, const NodalForces& forces,
                                    Eigen::VectorXd& increment);
  /// Drops the factors, which a run that goes on from here does not have.
  void forget() { matrix_.resize(0, 0); }

 private:
  DirectSolver solver_;
  Eigen::SparseMatrix<double> matrix_;  ///< of the factors; without rows where there is no factor
};

}  // namespace polargrain::fem
