// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <optional>

namespace polargrain::band {

/// Unknowns that make a sum of squared differences least: Levenberg and Marquardt's method.
/// @param visit visit(unknowns, gives_derivatives, each) calls each(weight, difference, derivatives of the difference) for every
/// sample; derivatives may be anything where they are not asked for
/// @param moving the first unknowns, whose last change must be below 1e-6
/// @returns nothing when they do not settle
template <int count, class Visit>
std::optional<Eigen::Matrix<double, count, 1>> least_squares(Eigen::Matrix<double, count, 1> unknowns,
                                                             int moving, const Visit& visit) {
  using Vector = Eigen::Matrix<double, count, 1>;
  using Matrix = Eigen::Matrix<double, count, count>;
  constexpr int kMostSteps = 200;
  constexpr double kSettled = 1e-6;
  const auto sum_of_squares = [&](const Vector& at, Vector* gradient, Matrix* curvature) {
    double sum = 0.0;
    if (gradient) gradient->setZero();
    if (curvature) curvature->setZero();
    visit(at, gradient != nullptr, [&](double weight, double difference, const Vector& by_unknowns) {
      sum += weight * difference * difference;
      if (!gradient) return;
      *gradient += weight * difference * by_unknowns;
      *curvature += weight * by_unknowns * by_unknowns.transpose();
    });
    return sum;
  };
  double damping = 1e-3;
  for (int step = 0; step < kMostSteps; ++step) {
    Vector gradient;
    Matrix curvature;
    const double before = sum_of_squares(unknowns, &gradient, &curvature);
    Vector move;
    for (;; damping *= 4.0) {
      if (damping > 1e12) return unknowns;  // no smaller sum to round-off
      Matrix damped = curvature;
      damped.diagonal() *= 1.0 + damping;
      move = -damped.ldlt().solve(gradient);
      if (sum_of_squares(unknowns + move, nullptr, nullptr) <= before) break;
    }
    damping *= 0.1;
    unknowns += move;
    if (move.head(moving).cwiseAbs().maxCoeff() < kSettled) return unknowns;
  }
  return std::nullopt;
}

}  // namespace polargrain::band
