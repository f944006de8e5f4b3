// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <vector>

#include "fem/solver/constraints.hpp"

namespace polargrain::fem {

/// Unbalanced forces and moments, relative to the fixed references of a run.
struct Residual {
  double force = 0.0;
  double moment = 0.0;
  std::vector<double> fields =
      {};  ///< by nodal field: absolute unbalanced rows over the absolute parts of all rows
};

/// Sums of absolute forces and moments over the free entries of `unbalanced`, relative to the references. Zero
/// over a reference of zero is zero.
template <int dim>
Residual measure(const Eigen::VectorXd& unbalanced, const Constraints<dim>& constraints,
                 double reference_force, double reference_length);

/// Residual::fields. @param parts see NodalForces
template <int dim>
std::vector<double> measure_fields(const Eigen::VectorXd& unbalanced, const Eigen::VectorXd& parts,
                                   const Constraints<dim>& constraints);

/// Sum of the absolute forces (not moments) at the given entries of a nodal vector.
template <int dim>
double sum_of_reactions(const Eigen::VectorXd& forces, const Constraints<dim>& constraints);

/// Watches one sequence of iterations.
class StagnationWatch {
 public:
  explicit StagnationWatch(int window) : window_(static_cast<std::size_t>(window)) {}
  /// @param excess largest residual over its tolerance.
  /// @return true when the smallest value of the last `window` iterations is not a tenth below the smallest
  /// one before them.
  bool stagnates(double excess);

 private:
  std::size_t window_;
  std::vector<double> smallest_;
};

}  // namespace polargrain::fem
