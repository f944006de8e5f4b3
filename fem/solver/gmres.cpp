// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/gmres.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <vector>

namespace polargrain::fem {
namespace {

/// A rotation that turns the Hessenberg matrix of GMRES into a triangle.
struct Givens {
  double cosine, sine;
  void apply(double& first, double& second) const {
    const double turned = cosine * first + sine * second;
    second = -sine * first + cosine * second;
    first = turned;
  }
};

}  // namespace

std::optional<Eigen::VectorXd> gmres(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& precondition,
    const Eigen::VectorXd& right_side, const GmresLimits& limits, int& iterations) {
  iterations = 0;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(right_side.size());
  const double goal = limits.tolerance * right_side.norm();
  if (right_side.isZero(0.0)) return x;
  if (!std::isfinite(goal)) return std::nullopt;
  const int restart = limits.restart;
  Eigen::VectorXd residual = right_side;
  double before = std::numeric_limits<double>::infinity();  // the residual at the last begin
  while (true) {
    double size = residual.norm();
    if (size <= goal) return x;
    if (iterations >= limits.most_iterations || size > limits.least_progress * before) return std::nullopt;
    before = size;
    std::vector<Eigen::VectorXd> directions{residual / size};
    Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(restart, restart);
    std::vector<Givens> turns;
    Eigen::VectorXd projected = Eigen::VectorXd::Zero(restart + 1);
    projected(0) = size;
    int count = 0;
    while (count < restart && iterations < limits.most_iterations && size > goal) {
      ++iterations;
      Eigen::VectorXd next = apply(precondition(directions.back()));
      Eigen::VectorXd column = Eigen::VectorXd::Zero(restart + 1);
      for (int i = 0; i <= count; ++i) {
        column(i) = next.dot(directions[static_cast<std::size_t>(i)]);
        next -= column(i) * directions[static_cast<std::size_t>(i)];
      }
      const double left = next.norm();
      if (!std::isfinite(left)) return std::nullopt;
      column(count + 1) = left;
      for (int i = 0; i < count; ++i) turns[static_cast<std::size_t>(i)].apply(column(i), column(i + 1));
      const double length = std::sqrt(column(count) * column(count) + left * left);
      if (length == 0.0) return std::nullopt;  // the preconditioned matrix is singular
      turns.push_back({column(count) / length, left / length});
      turns.back().apply(column(count), column(count + 1));
      turns.back().apply(projected(count), projected(count + 1));
      triangle.col(count) = column.head(restart);
      size = std::abs(projected(count + 1));
      ++count;
      if (left == 0.0) break;
      directions.emplace_back(next / left);
    }
    const Eigen::VectorXd shares =
        triangle.topLeftCorner(count, count).triangularView<Eigen::Upper>().solve(projected.head(count));
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(x.size());
    for (int i = 0; i < count; ++i) sum += shares(i) * directions[static_cast<std::size_t>(i)];
    x += precondition(sum);
    residual = right_side - apply(x);
  }
}

}  // namespace polargrain::fem
