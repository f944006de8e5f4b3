// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/field_balance.hpp"

#include <algorithm>
#include <cmath>

#include "fem/solver/residual.hpp"

namespace polargrain::fem {

PartsOfElement parts_of_element(const std::vector<int>& entries, Eigen::Index mechanics) {
  PartsOfElement parts;
  for (std::size_t k = 0; k < entries.size(); ++k)
    (entries[k] < mechanics ? parts.mechanics : parts.fields).push_back(static_cast<Eigen::Index>(k));
  return parts;
}

template <int dim>
Eigen::SparseMatrix<double> matrix_of_fields(const Problem<dim>& problem,
                                             const Constraints<dim>& constraints) {
  const int mechanical = constraints.mechanical_unknowns();
  const int unknowns = constraints.field_unknowns();
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& contribution : problem.contributions) {
    for (std::size_t e = 0; e < contribution->elements(); ++e) {
      const std::vector<int>& own = contribution->entries(e);
      const PartsOfElement parts = parts_of_element(own, constraints.places().mechanics());
      if (parts.fields.empty() || !contribution->is_active(e)) continue;
      const Eigen::MatrixXd tangent = contribution->tangent(e);
      const auto unknown = [&](Eigen::Index k) {
        return constraints.equation(static_cast<std::size_t>(own[static_cast<std::size_t>(k)])) - mechanical;
      };
      for (const Eigen::Index i : parts.fields)
        for (const Eigen::Index j : parts.fields)
          if (unknown(i) >= 0 && unknown(j) >= 0)
            entries.emplace_back(unknown(i), unknown(j), -tangent(i, j));
    }
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

namespace {

/// The share of a change at which a falling or growing function of it vanishes; 1 where it does not change its sign.
template <class Slope>
double share_without_slope(const Slope& slope) {
  constexpr int kMostTries = 20;
  constexpr double kNear = 0.1;  // of the slope at first
  double low = 0.0, high = 1.0;
  const double first = slope(low);
  if (!(first * slope(high) < 0.0)) return 1.0;
  for (int k = 0; k < kMostTries; ++k) {
    const double middle = 0.5 * (low + high), here = slope(middle);
    if (std::abs(here) <= kNear * std::abs(first)) return middle;
    (here * first > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

template <int dim>
std::string FieldBalance<dim>::balance(const Problem<dim>& problem, const Constraints<dim>& constraints,
                                       const Evaluate& evaluate, const NodalForces& forces,
                                       Eigen::VectorXd& increment) {
  constexpr int kMostIterations = 100;
  constexpr double kProgress = 0.1;  // of the excess, that factors of an earlier step must bring
  const int mechanical = constraints.mechanical_unknowns();
  const int unknowns = constraints.field_unknowns();
  double last = HUGE_VAL;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    if (std::string why = evaluate(increment); !why.empty()) return why;
    const std::vector<double> residuals =
        measure_fields<dim>(constraints.folded(forces.internal), forces.parts, constraints);
    if (!std::ranges::all_of(residuals, [](double one) { return std::isfinite(one); })) break;
    double excess = 0.0;
    for (std::size_t field = 0; field < residuals.size(); ++field)
      excess = std::max(excess, residuals[field] / problem.fields[field].tolerance);
    if (excess <= 1.0) return {};
    const bool falls = excess <= kProgress * last;
    if (matrix_.rows() != unknowns || (iteration > 0 && !falls)) {
      matrix_ = matrix_of_fields(problem, constraints);
      if (!solver_.factorise(matrix_)) break;
    }
    last = excess;
    const auto rows = [&]() -> Eigen::VectorXd {
      return constraints.restrict_to_free(forces.internal).segment(mechanical, unknowns);
    };
    Eigen::VectorXd change = Eigen::VectorXd::Zero(constraints.unknowns());
    change.segment(mechanical, unknowns) = solver_.solve(rows());
    if (!change.allFinite()) break;
    double share = 1.0;
    // Whole changes may go round in a circle of nodes that slip. The linear rows are balanced by now; the others are the slope of
    // a convex function, which becomes smaller each time.
    if (iteration > 1)
      share = share_without_slope([&](double tried) {
        Eigen::VectorXd there = increment;
        constraints.add_free(tried * change, there);
        return evaluate(there).empty() ? change.segment(mechanical, unknowns).dot(rows()) : 0.0;
      });
    constraints.add_free(share * change, increment);
  }
  forget();
  return "the fields beside the displacements cannot be carried on";
}

template Eigen::SparseMatrix<double> matrix_of_fields<2>(const Problem<2>&, const Constraints<2>&);
template Eigen::SparseMatrix<double> matrix_of_fields<3>(const Problem<3>&, const Constraints<3>&);
template class FieldBalance<2>;
template class FieldBalance<3>;

}  // namespace polargrain::fem
