// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/equation_scaling.hpp"

#include <cmath>

namespace polargrain::fem {

Eigen::VectorXd equation_scaling(const Eigen::SparseMatrix<double>& tangent, Eigen::Index first_field) {
  const auto of = [](double pivot) { return pivot > 0.0 ? 1.0 / std::sqrt(pivot) : 1.0; };
  Eigen::VectorXd factors(tangent.cols());
  for (Eigen::Index column = 0; column < tangent.cols(); ++column) {
    double pivot = 0.0;
    for (Eigen::SparseMatrix<double>::InnerIterator entry(tangent, column); entry; ++entry) {
      if (entry.row() == column) {
        pivot += std::abs(entry.value());
      } else if (column >= first_field && entry.row() < first_field) {
        const double coupling = factors(entry.row()) * entry.value();
        pivot += coupling * coupling;
      }
    }
    factors(column) = of(pivot);
  }
  return factors;
}

}  // namespace polargrain::fem
