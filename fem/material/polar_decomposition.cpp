// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/polar_decomposition.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "common/elementary_functions.hpp"

namespace polargrain::fem {
namespace {

/// Below this angle (rad) the series of the functions of an angle are exact to rounding.
constexpr double kSmallAngle = 1e-3;

/// sin x / x, (1 - cos x) / x^2, (x - sin x) / x^3
struct Coefficients {
  double first, second, third;
  explicit Coefficients(double x) {
    const double square = x * x;
    if (x < kSmallAngle) {
      first = 1.0 - square / 6.0 * (1.0 - square / 20.0);
      second = 0.5 - square / 24.0 * (1.0 - square / 30.0);
      third = 1.0 / 6.0 - square / 120.0 * (1.0 - square / 42.0);
      return;
    }
    const auto [sine, cosine] = sine_and_cosine(x);
    first = sine / x;
    second = (1.0 - cosine) / square;
    third = (x - sine) / (square * x);
  }
};

}  // namespace

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d made;
  made << 0.0, -a(2), a(1), a(2), 0.0, -a(0), -a(1), a(0), 0.0;
  return made;
}

Eigen::Vector3d axial(const Eigen::Matrix3d& m) {
  return 0.5 * Eigen::Vector3d(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
}

Eigen::Matrix3d rotation_by(const Eigen::Vector3d& vector) {
  const Coefficients c(vector.norm());
  const Eigen::Matrix3d w = cross_matrix(vector);
  return Eigen::Matrix3d::Identity() + c.first * w + c.second * w * w;
}

Eigen::Vector3d vector_of(const Eigen::Matrix3d& rotation) {
  const Eigen::Vector3d direction = axial(rotation);  // sin(angle) axis
  const double sine = direction.norm();
  if (sine == 0.0) return Eigen::Vector3d::Zero();
  return arc_tangent(sine, 0.5 * (rotation.trace() - 1.0)) / sine * direction;
}

// By quaternions, which lose no digits of small angles.
Eigen::Vector3d composed(const Eigen::Vector3d& after, const Eigen::Vector3d& before) {
  const Eigen::Vector3d sum = after + before;
  if (after.cross(before).isZero(0.0)) return sum;  // about one axis
  const auto quaternion = [](const Eigen::Vector3d& vector) {
    const double half = 0.5 * vector.norm();
    return std::pair{cosine(half), Eigen::Vector3d(0.5 * Coefficients(half).first * vector)};
  };
  const auto [a, x] = quaternion(after);
  const auto [b, y] = quaternion(before);
  const Eigen::Vector3d part = a * y + b * x + x.cross(y);
  const double sine = part.norm();
  if (sine == 0.0) return sum;
  const Eigen::Vector3d axis = part / sine;
  const double angle = 2.0 * arc_tangent(sine, a * b - x.dot(y));
  return (angle + 2.0 * M_PI * std::round((sum.dot(axis) - angle) / (2.0 * M_PI))) * axis;
}

Eigen::Matrix3d right_jacobian(const Eigen::Vector3d& vector) {
  const Coefficients c(vector.norm());
  const Eigen::Matrix3d w = cross_matrix(vector);
  return Eigen::Matrix3d::Identity() - c.second * w + c.third * w * w;
}

Eigen::Matrix3d inverse_right_jacobian(const Eigen::Vector3d& vector) {
  const double x = vector.norm();
  const Eigen::Matrix3d w = cross_matrix(vector);
  double third = 1.0 / 12.0 + x * x / 720.0;
  if (x >= kSmallAngle) {
    const Coefficients c(x);
    third = (1.0 - 0.5 * c.first / c.second) / (x * x);
  }
  return Eigen::Matrix3d::Identity() + 0.5 * w + third * w * w;
}

PolarDecomposition::PolarDecomposition(const Eigen::Matrix3d& h) {
  const Eigen::Matrix3d green = h + h.transpose() + h.transpose() * h;  // U^2 - I
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(green);
  stretches_ = (1.0 + solver.eigenvalues().array()).sqrt();
  axes_ = solver.eigenvectors();
  const auto with = [&](const Eigen::Array3d& values) -> Eigen::Matrix3d {
    return axes_ * values.matrix().asDiagonal() * axes_.transpose();
  };
  rotation = (Eigen::Matrix3d::Identity() + h) * with(stretches_.inverse());
  vector = vector_of(rotation);
  half_way_back = rotation_by(-0.5 * vector);
  strain = with(2.0 * solver.eigenvalues().array() / (1.0 + stretches_).square());
  inverse = with((1.0 + stretches_).inverse());
  stretch = with(stretches_);
}

PolarDecomposition::Change PolarDecomposition::change(const Eigen::Matrix3d& turned_back) const {
  // The skew part of turned_back - [spin]x U must vanish: W U + U W = turned_back - turned_back^T, in the axes of U.
  Eigen::Matrix3d skew = axes_.transpose() * (turned_back - turned_back.transpose()) * axes_;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) skew(i, j) /= stretches_(i) + stretches_(j);
  const Eigen::Matrix3d spin = axes_ * skew * axes_.transpose();
  const Eigen::Matrix3d stretching = turned_back - spin * stretch;
  return {axial(spin), 0.5 * (stretching + stretching.transpose())};
}

}  // namespace polargrain::fem
