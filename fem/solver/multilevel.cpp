// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/multilevel.hpp"

#include "fem/solver/aggregation.hpp"
#include "fem/solver/gmres.hpp"

namespace polargrain::fem {
namespace {

/// A level must be smaller than the last one by this, or more of them are no help.
constexpr double kWorthwhile = 0.7;

/// 1 / sqrt(|diagonal|); not finite where it is zero.
template <class Matrix>
Eigen::VectorXd scale_of(const Matrix& matrix) {
  return Eigen::VectorXd(matrix.diagonal()).cwiseAbs().cwiseSqrt().cwiseInverse();
}

/// Multiplies rows and columns by the factors, in place: the matrix may fill a tenth of the memory.
void scale(Eigen::SparseMatrix<double, Eigen::RowMajor>& matrix, const Eigen::VectorXd& factors) {
  for (int row = 0; row < matrix.outerSize(); ++row)
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(matrix, row); entry; ++entry)
      entry.valueRef() *= factors(row) * factors(entry.col());
}

}  // namespace

MultilevelSolver::MultilevelSolver(const CoarseSpace& space, int direct_unknowns)
    : space_(space), direct_unknowns_(direct_unknowns) {}

bool MultilevelSolver::factorise(const Eigen::SparseMatrix<double>& matrix) {
  levels_.clear();
  scale_ = scale_of(matrix);
  if (!scale_.allFinite()) return false;
  UnknownGroups groups = space_.groups;
  groups.motions = scale_.cwiseInverse().asDiagonal() * groups.motions;
  {
    Level& finest = levels_.emplace_back();
    finest.matrix = matrix;
    scale(finest.matrix, scale_);
    finest.begins = groups.begins;
    if (!finest.smoother.learn(finest.matrix, finest.begins)) return false;
  }
  if (space_.from_corners.cols() > 0) {
    levels_.back().prolongation = scale_.cwiseInverse().asDiagonal() * space_.from_corners;
    groups = space_.corners;
    if (!coarsen(groups)) return false;
  }
  while (levels_.back().matrix.rows() > direct_unknowns_) {
    Level& last = levels_.back();
    Aggregation made = aggregate(last.matrix, groups, last.smoother);
    if (static_cast<double>(made.prolongation.cols()) > kWorthwhile * static_cast<double>(last.matrix.rows()))
      break;
    last.prolongation = std::move(made.prolongation);
    groups = std::move(made.groups);
    if (!coarsen(groups)) return false;
  }
  coarsest_matrix_ = levels_.back().matrix;
  coarsest_.forget_pattern();
  return coarsest_.factorise(coarsest_matrix_);
}

bool MultilevelSolver::coarsen(UnknownGroups& groups) {
  Matrix& prolongation = levels_.back().prolongation;
  Level next;
  {
    const Matrix image = levels_.back().matrix * prolongation;
    next.matrix = Matrix(prolongation.transpose()) * image;
  }
  const Eigen::VectorXd factors = scale_of(next.matrix);
  if (!factors.allFinite()) return false;
  scale(next.matrix, factors);
  prolongation = prolongation * factors.asDiagonal();
  groups.motions = factors.cwiseInverse().asDiagonal() * groups.motions;
  next.begins = groups.begins;
  if (!next.smoother.learn(next.matrix, next.begins)) return false;
  levels_.push_back(std::move(next));
  return true;
}

std::vector<int> MultilevelSolver::unknowns_of_levels() const {
  std::vector<int> unknowns;
  for (const Level& level : levels_) unknowns.push_back(static_cast<int>(level.matrix.rows()));
  return unknowns;
}

Eigen::VectorXd MultilevelSolver::cycle(std::size_t level, const Eigen::VectorXd& right_side) const {
  if (level + 1 == levels_.size()) return coarsest_.solve(right_side);
  const Level& own = levels_[level];
  Eigen::VectorXd x = Eigen::VectorXd::Zero(right_side.size());
  own.smoother.sweep(own.matrix, own.begins, right_side, true, x);
  const Eigen::VectorXd rest = right_side - own.matrix * x;
  x += own.prolongation * cycle(level + 1, own.prolongation.transpose() * rest);
  own.smoother.sweep(own.matrix, own.begins, right_side, false, x);
  return x;
}

std::optional<Eigen::VectorXd> MultilevelSolver::solve(const Eigen::VectorXd& right_side) {
  const auto apply = [this](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return levels_.front().matrix * x;
  };
  const auto precondition = [this](const Eigen::VectorXd& x) { return cycle(0, x); };
  std::optional<Eigen::VectorXd> found =
      gmres(apply, precondition, scale_.cwiseProduct(right_side), {}, iterations_);
  if (found) *found = scale_.cwiseProduct(*found);
  return found;
}

}  // namespace polargrain::fem
