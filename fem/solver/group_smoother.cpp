// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/group_smoother.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace polargrain::fem {

bool GroupSmoother::learn(const Matrix& matrix, const std::vector<int>& begins) {
  inverses_.clear();
  places_.clear();
  largest_ = 0;
  for (std::size_t group = 0; group + 1 < begins.size(); ++group) {
    const int begin = begins[group];
    const int size = begins[group + 1] - begin;
    largest_ = std::max(largest_, size);
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(size, size);
    for (int i = 0; i < size; ++i)
      for (Matrix::InnerIterator entry(matrix, begin + i); entry; ++entry)
        if (entry.col() >= begin && entry.col() < begin + size) own(i, entry.col() - begin) = entry.value();
    const Eigen::MatrixXd inverse = own.inverse();
    if (!inverse.allFinite()) return false;
    places_.push_back(inverses_.size());
    inverses_.insert(inverses_.end(), inverse.data(), inverse.data() + inverse.size());
  }
  return true;
}

void GroupSmoother::sweep(const Matrix& matrix, const std::vector<int>& begins,
                          const Eigen::VectorXd& right_side, bool forwards, Eigen::VectorXd& x) const {
  const int* starts = matrix.outerIndexPtr();
  const int* columns = matrix.innerIndexPtr();
  const double* values = matrix.valuePtr();
  std::vector<double> rest(static_cast<std::size_t>(largest_));
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const std::size_t group = forwards ? k : places_.size() - 1 - k;
    const int begin = begins[group];
    const int size = begins[group + 1] - begin;
    for (int i = 0; i < size; ++i) {
      double sum = right_side(begin + i);
      for (int entry = starts[begin + i]; entry < starts[begin + i + 1]; ++entry)
        sum -= values[entry] * x(columns[entry]);
      rest[static_cast<std::size_t>(i)] = sum;
    }
    const double* inverse = inverses_.data() + places_[group];
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i)
        x(begin + i) += inverse[j * size + i] * rest[static_cast<std::size_t>(j)];
  }
}

}  // namespace polargrain::fem
