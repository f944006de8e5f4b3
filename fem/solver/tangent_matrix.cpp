// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/tangent_matrix.hpp"

#include <algorithm>

namespace polargrain::fem {

template <int dim>
TangentMatrix<dim>::TangentMatrix(const Discretisation<dim>& discretisation,
                                  const Constraints<dim>& constraints, const ContributionList& contributions)
    : discretisation_(discretisation), constraints_(constraints), contributions_(contributions) {
  renew();
}

template <int dim>
void TangentMatrix<dim>::renew() {
  matrix_ = Eigen::SparseMatrix<double>(constraints_.unknowns(), constraints_.unknowns());
  equations_.clear();
  places_.clear();
  const auto add_element = [&](const std::vector<int>& entries, bool is_there) {
    std::vector<int>& equations = equations_.emplace_back();
    if (!is_there) return;
    for (const int entry : entries)
      equations.push_back(constraints_.equation(static_cast<std::size_t>(entry)));
  };
  for (std::size_t e = 0; e < discretisation_.elements(); ++e)
    add_element(discretisation_.element_dofs(e), discretisation_.is_there(e));
  for (const auto& contribution : contributions_)
    for (std::size_t e = 0; e < contribution->elements(); ++e)
      add_element(contribution->entries(e), contribution->is_active(e));
  find_pattern();
  find_places();
}

template <int dim>
void TangentMatrix<dim>::find_pattern() {
  std::vector<std::vector<int>> rows(static_cast<std::size_t>(matrix_.cols()));
  for (const std::vector<int>& equations : equations_) {
    for (const int column : equations) {
      if (column < 0) continue;
      std::vector<int>& list = rows[static_cast<std::size_t>(column)];
      std::copy_if(equations.begin(), equations.end(), std::back_inserter(list),
                   [](int r) { return r >= 0; });
    }
  }
  std::vector<int> starts{0};
  std::vector<int> all_rows;
  for (std::vector<int>& list : rows) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    all_rows.insert(all_rows.end(), list.begin(), list.end());
    starts.push_back(static_cast<int>(all_rows.size()));
  }
  const std::vector<double> zeros(all_rows.size(), 0.0);
  matrix_ = Eigen::Map<const Eigen::SparseMatrix<double>>(matrix_.rows(), matrix_.cols(),
                                                          static_cast<Eigen::Index>(all_rows.size()),
                                                          starts.data(), all_rows.data(), zeros.data());
}

template <int dim>
int TangentMatrix<dim>::place_of(int row, int column) const {
  const int* starts = matrix_.outerIndexPtr();
  const int* rows = matrix_.innerIndexPtr();
  return static_cast<int>(std::lower_bound(rows + starts[column], rows + starts[column + 1], row) - rows);
}

template <int dim>
void TangentMatrix<dim>::find_places() {
  for (const std::vector<int>& equations : equations_) {
    for (const int column : equations) {
      if (column < 0) continue;
      for (const int row : equations) {
        if (row < 0) continue;
        places_.push_back(place_of(row, column));
      }
    }
  }
}

template <int dim>
void TangentMatrix<dim>::add(const Eigen::MatrixXd& local, const std::vector<int>& equations,
                             std::vector<int>::const_iterator& place) {
  double* values = matrix_.valuePtr();
  for (std::size_t j = 0; j < equations.size(); ++j) {
    if (equations[j] < 0) continue;
    for (std::size_t i = 0; i < equations.size(); ++i) {
      if (equations[i] < 0) continue;
      values[*place++] += local(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
}

template <int dim>
const Eigen::SparseMatrix<double>& TangentMatrix<dim>::assemble(const Linearisation<dim>& of,
                                                                const std::vector<LoadStiffness>& loads) {
  double* values = matrix_.valuePtr();
  std::fill(values, values + matrix_.nonZeros(), 0.0);
  auto place = places_.cbegin();
  auto equations = equations_.cbegin();
  for (std::size_t e = 0; e < discretisation_.elements(); ++e, ++equations)
    if (!equations->empty()) add(discretisation_.element_tangent(e, of), *equations, place);
  for (const auto& contribution : contributions_)
    for (std::size_t e = 0; e < contribution->elements(); ++e, ++equations)
      if (contribution->is_active(e)) add(contribution->tangent(e), *equations, place);
  // The nodes of an edge belong to one element, so the pattern holds their entries.
  for (const LoadStiffness& edge : loads) {
    for (std::size_t j = 0; j < edge.entries.size(); ++j) {
      const int column = constraints_.equation(static_cast<std::size_t>(edge.entries[j]));
      if (column < 0) continue;
      for (std::size_t i = 0; i < edge.entries.size(); ++i) {
        const int row = constraints_.equation(static_cast<std::size_t>(edge.entries[i]));
        if (row < 0) continue;
        values[place_of(row, column)] -=
            edge.values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
    }
  }
  return matrix_;
}

template class TangentMatrix<2>;
template class TangentMatrix<3>;

}  // namespace polargrain::fem
