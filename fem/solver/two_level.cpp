// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/two_level.hpp"

#include <Eigen/LU>
#include <cmath>

namespace polargrain::fem {
namespace {

constexpr double kTolerance = 1e-10;
/// Directions that are kept; then GMRES begins anew.
constexpr int kRestart = 80;
constexpr int kMostIterations = 240;

/// The rotations that turn the Hessenberg matrix of GMRES into a triangle.
struct Givens {
  double cosine, sine;
  void apply(double& first, double& second) const {
    const double turned = cosine * first + sine * second;
    second = -sine * first + cosine * second;
    first = turned;
  }
};

}  // namespace

bool TwoLevelSolver::factorise(const Eigen::SparseMatrix<double>& matrix) {
  matrix_ = matrix;
  scale_ = matrix.diagonal().cwiseAbs();
  if (!(scale_.minCoeff() > 0.0)) return false;
  scale_ = scale_.cwiseSqrt().cwiseInverse();
  node_inverses_.clear();
  for (std::size_t node = 0; node + 1 < space_.node_begins.size(); ++node) {
    const int begin = space_.node_begins[node];
    const int size = space_.node_begins[node + 1] - begin;
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(size, size);
    for (int i = 0; i < size; ++i)
      for (decltype(matrix_)::InnerIterator entry(matrix_, begin + i); entry; ++entry)
        if (entry.col() >= begin && entry.col() < begin + size) own(i, entry.col() - begin) = entry.value();
    node_inverses_.emplace_back(own.inverse());
    if (!node_inverses_.back().allFinite()) return false;
  }
  {
    const Eigen::SparseMatrix<double> half =
        matrix * space_.prolongation;  // large: gone before the factors come
    coarse_matrix_ = space_.prolongation.transpose() * half;
  }
  return coarse_.factorise(coarse_matrix_);
}

void TwoLevelSolver::sweep(const Eigen::VectorXd& right_side, bool forwards, Eigen::VectorXd& x) const {
  const int* starts = matrix_.outerIndexPtr();
  const int* columns = matrix_.innerIndexPtr();
  const double* values = matrix_.valuePtr();
  const auto nodes = node_inverses_.size();
  Eigen::VectorXd rest;
  for (std::size_t k = 0; k < nodes; ++k) {
    const std::size_t node = forwards ? k : nodes - 1 - k;
    const int begin = space_.node_begins[node];
    const auto size = node_inverses_[node].rows();
    rest = right_side.segment(begin, size);
    for (Eigen::Index i = 0; i < size; ++i) {
      const Eigen::Index row = begin + i;
      double sum = 0.0;
      for (int entry = starts[row]; entry < starts[row + 1]; ++entry)
        sum += values[entry] * x(columns[entry]);
      rest(i) -= sum;
    }
    x.segment(begin, size).noalias() += node_inverses_[node] * rest;
  }
}

Eigen::VectorXd TwoLevelSolver::precondition(const Eigen::VectorXd& residual) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(residual.size());
  sweep(residual, true, x);
  const Eigen::VectorXd rest = residual - matrix_ * x;
  const Eigen::VectorXd of_corners = space_.prolongation.transpose() * rest;
  x += space_.prolongation * coarse_.solve(of_corners);
  sweep(residual, false, x);
  return x;
}

std::optional<Eigen::VectorXd> TwoLevelSolver::solve(const Eigen::VectorXd& right_side) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(right_side.size());
  const double whole = scale_.cwiseProduct(right_side).norm();
  iterations_ = 0;
  if (whole == 0.0) return x;
  if (!std::isfinite(whole)) return std::nullopt;
  while (iterations_ < kMostIterations) {
    // Scaled from the left, so that forces and moments weigh alike; preconditioned from the right.
    Eigen::VectorXd residual = scale_.cwiseProduct(right_side - matrix_ * x);
    double size = residual.norm();
    if (size <= kTolerance * whole) return x;
    std::vector<Eigen::VectorXd> directions{residual / size};
    Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(kRestart, kRestart);
    std::vector<Givens> turns;
    Eigen::VectorXd projected = Eigen::VectorXd::Zero(kRestart + 1);
    projected(0) = size;
    int count = 0;
    while (count < kRestart && iterations_ < kMostIterations && size > kTolerance * whole) {
      ++iterations_;
      const Eigen::VectorXd image = precondition(directions.back().cwiseQuotient(scale_));
      Eigen::VectorXd next = scale_.cwiseProduct(matrix_ * image);
      Eigen::VectorXd column = Eigen::VectorXd::Zero(kRestart + 1);
      for (int i = 0; i <= count; ++i) {
        column(i) = next.dot(directions[static_cast<std::size_t>(i)]);
        next -= column(i) * directions[static_cast<std::size_t>(i)];
      }
      const double left = next.norm();
      if (!std::isfinite(left)) return std::nullopt;
      column(count + 1) = left;
      for (int i = 0; i < count; ++i) turns[static_cast<std::size_t>(i)].apply(column(i), column(i + 1));
      const double length = std::hypot(column(count), left);
      if (length == 0.0) return std::nullopt;
      turns.push_back({column(count) / length, left / length});
      turns.back().apply(column(count), column(count + 1));
      turns.back().apply(projected(count), projected(count + 1));
      triangle.col(count) = column.head(kRestart);
      size = std::abs(projected(count + 1));
      ++count;
      if (left == 0.0) break;
      directions.emplace_back(next / left);
    }
    const Eigen::VectorXd shares =
        triangle.topLeftCorner(count, count).triangularView<Eigen::Upper>().solve(projected.head(count));
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(x.size());
    for (int i = 0; i < count; ++i) sum += shares(i) * directions[static_cast<std::size_t>(i)];
    x += precondition(sum.cwiseQuotient(scale_));
  }
  return std::nullopt;
}

}  // namespace polargrain::fem
