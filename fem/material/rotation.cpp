// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/rotation.hpp"

#include <Eigen/LU>
#include <cmath>

#include "common/elementary_functions.hpp"
#include "fem/material/polar_decomposition.hpp"

namespace polargrain::fem {
namespace {

Eigen::Matrix2d rotation(double angle) {
  const auto [sine, cosine] = sine_and_cosine(angle);
  Eigen::Matrix2d r;
  r << cosine, -sine, sine, cosine;
  return r;
}

/// The matrix that turns a Vector7.
Matrix7 rotation_of_components(double angle) {
  const Eigen::Matrix2d r = rotation(angle);
  constexpr int kPlace[2][2] = {{k11, k12}, {k21, k22}};
  Matrix7 turn = Matrix7::Zero();
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l) turn(kPlace[i][j], kPlace[k][l]) = r(i, k) * r(j, l);
  turn(k33, k33) = 1.0;
  turn.bottomRightCorner<2, 2>() = r;
  return turn;
}

/// 9 x 9: the effect of R t R^T on the components t_11, t_12 .. t_33.
Eigen::Matrix<double, 9, 9> rotation_of_tensor(const Eigen::Matrix3d& r) {
  Eigen::Matrix<double, 9, 9> turn;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) turn(3 * i + j, 3 * k + l) = r(i, k) * r(j, l);
  return turn;
}

}  // namespace

double rotation_angle(const Increment<2>& increment) {
  // The closed form of the plane: tan of the angle is (F21 - F12) / (F11 + F22).
  const Eigen::Matrix2d& h = increment.displacement_gradient;
  return arc_tangent(h(1, 0) - h(0, 1), 2.0 + h(0, 0) + h(1, 1));
}

StretchAndTurn<2> stretch_and_turn(const Increment<2>& increment) {
  if (increment.configuration == Configuration::fixed) return {increment, no_turn<2>()};
  const Eigen::Matrix2d& h = increment.displacement_gradient;
  const double sum = 2.0 + h(0, 0) + h(1, 1);
  const double difference = h(1, 0) - h(0, 1);
  const double trace = std::sqrt(sum * sum + difference * difference);  // of U
  const double volume = (1.0 + h(0, 0)) * (1.0 + h(1, 1)) - h(0, 1) * h(1, 0);
  // Twice the strain of Green, U^2 - I, of which small strains lose no digits; and (U + I) U = U^2 + U.
  const Eigen::Matrix2d green = h + h.transpose() + h.transpose() * h;
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d stretch = (green + (1.0 + volume) * one) / trace;
  const Eigen::Matrix2d inverse = (stretch + one).inverse();
  StretchAndTurn<2> step;
  step.turn = rotation_angle(increment);
  const Eigen::Matrix2d strain = 2.0 * green * inverse * inverse;
  step.stretch.displacement_gradient = 0.5 * (strain + strain.transpose());
  step.stretch.micro_rotation = increment.micro_rotation - step.turn;
  step.stretch.curvature = 2.0 * inverse * increment.curvature;
  return step;
}

Eigen::Vector2d rotated(const Eigen::Vector2d& vector, double angle) {
  return rotation(angle) * vector;
}

Vector7 rotated(const Vector7& components, double angle) {
  const Eigen::Matrix2d r = rotation(angle);
  Eigen::Matrix2d s;
  s << components(k11), components(k12), components(k21), components(k22);
  s = r * s * r.transpose();
  Vector7 turned;
  turned << s(0, 0), s(1, 1), components(k33), s(0, 1), s(1, 0), r * components.tail<2>();
  return turned;
}

Matrix7 rotated(const Matrix7& tangent, double angle) {
  const Matrix7 turn = rotation_of_components(angle);
  return turn * tangent * turn.transpose();
}

Eigen::Vector3d rotation_vector(const Increment<3>& increment) {
  return PolarDecomposition(increment.displacement_gradient).vector;
}

StretchAndTurn<3> stretch_and_turn(const Increment<3>& increment) {
  if (increment.configuration == Configuration::fixed) return {increment, no_turn<3>()};
  const PolarDecomposition parts(increment.displacement_gradient);
  StretchAndTurn<3> step;
  step.turn = parts.rotation;
  step.stretch.displacement_gradient = parts.strain;
  // Rotations of the step are vectors about its middle; the law has the axes of the start.
  step.stretch.rotation = parts.half_way_back * increment.rotation - parts.vector;
  step.stretch.curvature = 2.0 * parts.half_way_back * increment.curvature * parts.inverse;
  return step;
}

Vector18 rotated(const Vector18& components, const Eigen::Matrix3d& rotation) {
  const Eigen::Matrix<double, 9, 9> turn = rotation_of_tensor(rotation);
  Vector18 turned;
  turned << turn * components.head<9>(), turn * components.tail<9>();
  return turned;
}

Matrix18 rotated(const Matrix18& tangent, const Eigen::Matrix3d& rotation) {
  Matrix18 turn = Matrix18::Zero();
  turn.topLeftCorner<9, 9>() = turn.bottomRightCorner<9, 9>() = rotation_of_tensor(rotation);
  return turn * tangent * turn.transpose();
}

}  // namespace polargrain::fem
