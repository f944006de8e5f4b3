// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/aggregation.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace polargrain::fem {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Share of a block of the geometric mean of the two diagonal ones below which two groups are no neighbours.
constexpr double kStrong = 0.02;
/// Of the motions of an aggregate, over the largest: smaller ones are combinations of the others there.
constexpr double kIndependent = 1e-8;

/// The strong neighbours of each group, itself left out.
std::vector<std::vector<int>> strong_neighbours(const Matrix& matrix, const UnknownGroups& groups) {
  std::vector<int> group_of(static_cast<std::size_t>(groups.unknowns()));
  for (std::size_t group = 0; group < groups.count(); ++group)
    std::fill(group_of.begin() + groups.begins[group], group_of.begin() + groups.begins[group + 1],
              static_cast<int>(group));
  std::vector<double> diagonal(groups.count(), 0.0);
  std::vector<std::vector<std::pair<int, double>>> blocks(groups.count());  // with the squares of their norms
  std::vector<int> place(groups.count(), -1);
  for (std::size_t group = 0; group < groups.count(); ++group) {
    auto& own = blocks[group];
    for (int row = groups.begins[group]; row < groups.begins[group + 1]; ++row)
      for (Matrix::InnerIterator entry(matrix, row); entry; ++entry) {
        const auto other = static_cast<std::size_t>(group_of[static_cast<std::size_t>(entry.col())]);
        if (place[other] < 0) {
          place[other] = static_cast<int>(own.size());
          own.emplace_back(static_cast<int>(other), 0.0);
        }
        own[static_cast<std::size_t>(place[other])].second += entry.value() * entry.value();
      }
    for (const auto& [other, square] : own) {
      place[static_cast<std::size_t>(other)] = -1;
      if (static_cast<std::size_t>(other) == group) diagonal[group] = square;
    }
  }
  std::vector<std::vector<int>> strong(groups.count());
  for (std::size_t group = 0; group < groups.count(); ++group) {
    for (const auto& [other, square] : blocks[group]) {
      const auto second = static_cast<std::size_t>(other);
      if (second != group && square > kStrong * kStrong * std::sqrt(diagonal[group] * diagonal[second]))
        strong[group].push_back(other);
    }
    std::sort(strong[group].begin(), strong[group].end());
  }
  return strong;
}

/// Number of the aggregate of each group.
std::vector<int> aggregates(const std::vector<std::vector<int>>& neighbours, int& count) {
  std::vector<int> of(neighbours.size(), -1);
  count = 0;
  const auto taken = [&](int group) { return of[static_cast<std::size_t>(group)] >= 0; };
  for (std::size_t group = 0; group < of.size(); ++group) {
    const std::vector<int>& near = neighbours[group];
    if (of[group] >= 0 || near.empty() || std::any_of(near.begin(), near.end(), taken)) continue;
    of[group] = count;
    for (const int other : near) of[static_cast<std::size_t>(other)] = count;
    ++count;
  }
  // Groups that are left over join a neighbour of the first pass, or else each other.
  const std::vector<int> first_pass = of;
  for (std::size_t group = 0; group < of.size(); ++group) {
    if (of[group] >= 0) continue;
    for (const int other : neighbours[group])
      if (first_pass[static_cast<std::size_t>(other)] >= 0) {
        of[group] = first_pass[static_cast<std::size_t>(other)];
        break;
      }
  }
  for (std::size_t group = 0; group < of.size(); ++group) {
    if (of[group] >= 0) continue;
    of[group] = count;
    for (const int other : neighbours[group])
      if (!taken(other)) of[static_cast<std::size_t>(other)] = count;
    ++count;
  }
  return of;
}

/// The largest eigenvalue of the matrix behind Jacobi's iteration by groups, by powers.
double largest_eigenvalue(const Matrix& matrix, const UnknownGroups& groups, const GroupSmoother& smoother) {
  constexpr int kPowers = 12;
  Eigen::VectorXd x(matrix.rows());
  // Neither smooth nor periodic.
  for (Eigen::Index i = 0; i < x.size(); ++i) x(i) = static_cast<double>((i * 7919 + 13) % 101) / 50.0 - 1.0;
  double size = 1.0;
  for (int power = 0; power < kPowers; ++power) {
    x /= x.norm();
    const Eigen::VectorXd image = matrix * x;
    for (std::size_t group = 0; group < groups.count(); ++group) {
      const int begin = groups.begins[group];
      const int count = groups.begins[group + 1] - begin;
      x.segment(begin, count) = smoother.inverse(groups.begins, group) * image.segment(begin, count);
    }
    size = x.norm();
  }
  return size;
}

}  // namespace

Aggregation aggregate(const Matrix& matrix, const UnknownGroups& groups, const GroupSmoother& smoother) {
  int count = 0;
  const std::vector<int> of = aggregates(strong_neighbours(matrix, groups), count);
  std::vector<std::vector<int>> members(static_cast<std::size_t>(count));
  for (std::size_t group = 0; group < of.size(); ++group)
    members[static_cast<std::size_t>(of[group])].push_back(static_cast<int>(group));

  Aggregation made;
  const Eigen::Index motions = groups.motions.cols();
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd coarse_motions(static_cast<Eigen::Index>(count) * motions, motions);
  int columns = 0;
  for (const std::vector<int>& own : members) {
    std::vector<int> rows;
    for (const int group : own)
      for (int row = groups.begins[static_cast<std::size_t>(group)];
           row < groups.begins[static_cast<std::size_t>(group) + 1]; ++row)
        rows.push_back(row);
    Eigen::MatrixXd local(static_cast<Eigen::Index>(rows.size()), motions);
    for (std::size_t i = 0; i < rows.size(); ++i)
      local.row(static_cast<Eigen::Index>(i)) = groups.motions.row(rows[i]);
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(local);
    factors.setThreshold(kIndependent);
    const Eigen::Index rank = factors.rank();
    const Eigen::MatrixXd basis = factors.householderQ() * Eigen::MatrixXd::Identity(local.rows(), rank);
    made.groups.begins.push_back(columns);
    coarse_motions.middleRows(columns, rank) = basis.transpose() * local;
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (Eigen::Index j = 0; j < rank; ++j)
        entries.emplace_back(rows[i], columns + static_cast<int>(j), basis(static_cast<Eigen::Index>(i), j));
    columns += static_cast<int>(rank);
  }
  made.groups.begins.push_back(columns);
  made.groups.motions = coarse_motions.topRows(columns);
  Matrix rough(matrix.rows(), columns);
  rough.setFromTriplets(entries.begin(), entries.end());

  // One step of Jacobi's iteration by groups, damped by 4/3 of the largest eigenvalue.
  const double damping = 4.0 / 3.0 / largest_eigenvalue(matrix, groups, smoother);
  std::vector<Eigen::Triplet<double>> steps;
  for (std::size_t group = 0; group < groups.count(); ++group) {
    const int begin = groups.begins[group];
    const auto inverse = smoother.inverse(groups.begins, group);
    for (int i = 0; i < inverse.rows(); ++i)
      for (int j = 0; j < inverse.cols(); ++j)
        steps.emplace_back(begin + i, begin + j, damping * inverse(i, j));
  }
  Matrix step(matrix.rows(), matrix.rows());
  step.setFromTriplets(steps.begin(), steps.end());
  const Matrix image = matrix * rough;
  made.prolongation = rough - Matrix(step * image);
  return made;
}

}  // namespace polargrain::fem
