// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/box/rotation.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "common/elementary_functions.hpp"

namespace polargrain::dem {

Eigen::Matrix2d rotation_by(double angle) {
  const auto [sine, cosine] = sine_and_cosine(angle);
  Eigen::Matrix2d matrix;
  matrix << cosine, -sine, sine, cosine;
  return matrix;
}

Eigen::Matrix3d rotation_by(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d n = vector / angle;
  const auto [sine, cosine] = sine_and_cosine(angle);
  Eigen::Matrix3d cross;
  cross << 0.0, -n.z(), n.y(), n.z(), 0.0, -n.x(), -n.y(), n.x(), 0.0;
  return cosine * Eigen::Matrix3d::Identity() + sine * cross + (1.0 - cosine) * n * n.transpose();
}

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation) {
  const Eigen::Vector3d w = axial<3>(rotation);  // sine of the angle, along the axis
  const double sine = w.norm();
  if (sine == 0.0) return Eigen::Vector3d::Zero();
  return arc_tangent(sine, 0.5 * (rotation.trace() - 1.0)) / sine * w;
}

Eigen::Matrix3d rotation_of(const Eigen::Matrix3d& a) {
  constexpr int kMostIterations = 60;
  Eigen::Matrix3d now = a;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const Eigen::Matrix3d next = 0.5 * (now + now.inverse().transpose());
    const double change = (next - now).cwiseAbs().maxCoeff();
    now = next;
    if (change <= 1e-15) break;
  }
  return now;
}

TriangularParts triangular_parts(const Eigen::Matrix3d& a) {
  TriangularParts parts;
  parts.triangular.setZero();
  for (int column = 0; column < 3; ++column) {
    Eigen::Vector3d rest = a.col(column);
    for (int row = 0; row < column; ++row) {
      parts.triangular(row, column) = parts.rotation.col(row).dot(rest);
      rest -= parts.triangular(row, column) * parts.rotation.col(row);
    }
    parts.triangular(column, column) = rest.norm();
    parts.rotation.col(column) = rest / parts.triangular(column, column);
  }
  return parts;
}

}  // namespace polargrain::dem
