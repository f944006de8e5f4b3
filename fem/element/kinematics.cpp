// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/element/kinematics.hpp"

#include "fem/element/dofs.hpp"

#include <Eigen/LU>

#include "fem/material/rotation.hpp"

namespace polargrain::fem {

Eigen::Matrix2d jacobian(const Eigen::MatrixX2d& nodes, const ShapeFunctions& shape) {
  return nodes.transpose() * shape.derivative;
}

std::vector<PointGeometry> point_geometries(const ElementType& type, const Eigen::MatrixX2d& nodes) {
  std::vector<PointGeometry> points;
  double volume = 0.0;
  Eigen::MatrixX2d mean = Eigen::MatrixX2d::Zero(type.nodes, 2);
  for (const QuadraturePoint& place : type.quadrature) {
    const ShapeFunctions shape = type.shape_functions(place.position);
    const Eigen::Matrix2d j = jacobian(nodes, shape);
    PointGeometry point;
    point.position = nodes.transpose() * shape.value;
    point.volume = place.weight * j.determinant();
    point.shape = shape.value;
    point.gradient = shape.derivative * j.inverse();
    volume += point.volume;
    mean += point.volume * point.gradient;
    points.push_back(std::move(point));
  }
  if (type.mean_dilatation) {
    mean /= volume;
    for (PointGeometry& point : points) point.dilatation_correction = 0.5 * (mean - point.gradient);
  }
  return points;
}

Increment increment_at(const PointGeometry& point, Continuum continuum, const Eigen::VectorXd& dofs) {
  Increment increment;
  const auto nodes = point.shape.size();
  const Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>> values(dofs.data(), 3, nodes);
  Eigen::Matrix2d& h = increment.displacement_gradient;
  h = values.topRows<2>() * point.gradient;
  if (point.dilatation_correction.size() > 0) {
    const double correction = (values.topRows<2>() * point.dilatation_correction).trace();
    h(0, 0) += correction;
    h(1, 1) += correction;
  }
  if (continuum == Continuum::cosserat) {
    increment.micro_rotation = values.row(2).dot(point.shape);
    increment.curvature = (values.row(2) * point.gradient).transpose();
  } else {
    increment.micro_rotation = 0.5 * (h(1, 0) - h(0, 1));
  }
  return increment;
}

Increment large_increment_at(const PointGeometry& start, Continuum continuum, const Eigen::VectorXd& dofs,
                             double dilatation) {
  Increment increment;
  increment.configuration = Configuration::start;
  const Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>> values(dofs.data(), 3, start.shape.size());
  Eigen::Matrix2d& h = increment.displacement_gradient;
  h = values.topRows<2>() * start.gradient;
  if (dilatation != 1.0) h = dilatation * h + (dilatation - 1.0) * Eigen::Matrix2d::Identity();
  if (continuum == Continuum::cosserat) {
    increment.micro_rotation = values.row(2).dot(start.shape);
    increment.curvature = (values.row(2) * start.gradient).transpose();
  } else {
    increment.micro_rotation = rotation_angle(increment);
  }
  return increment;
}

Eigen::Matrix<double, 7, Eigen::Dynamic> strain_matrix(const PointGeometry& point, Continuum continuum) {
  const auto nodes = point.shape.size();
  Eigen::Matrix<double, 7, Eigen::Dynamic> b(7, entry_of(nodes));
  b.setZero();
  for (Eigen::Index a = 0; a < nodes; ++a) {
    const double d1 = point.gradient(a, 0);
    const double d2 = point.gradient(a, 1);
    auto u1 = b.col(entry_of(a, Dof::u1));
    auto u2 = b.col(entry_of(a, Dof::u2));
    auto w = b.col(entry_of(a, Dof::w));
    u1(k11) = d1;
    u2(k22) = d2;
    if (point.dilatation_correction.size() > 0) {
      for (const int row : {k11, k22}) {
        u1(row) += point.dilatation_correction(a, 0);
        u2(row) += point.dilatation_correction(a, 1);
      }
    }
    if (continuum == Continuum::cosserat) {
      u2(k12) = d1;
      u1(k21) = d2;
      w(k12) = -point.shape(a);
      w(k21) = point.shape(a);
      w(kCurvature1) = d1;
      w(kCurvature2) = d2;
    } else {
      for (const int row : {k12, k21}) {
        u1(row) = 0.5 * d2;
        u2(row) = 0.5 * d1;
      }
    }
  }
  return b;
}

}  // namespace polargrain::fem
