// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/rotation.hpp"

#include <Eigen/LU>
#include <cmath>

#include "common/elementary_functions.hpp"

namespace polargrain::fem {

double rotation_angle(const Increment& increment) {
  const Eigen::Matrix2d& h = increment.displacement_gradient;
  return 2.0 * arc_tangent(0.25 * (h(1, 0) - h(0, 1)));
}

Increment about_start(const Increment& about_middle) {
  const Eigen::Matrix2d half = 0.5 * about_middle.displacement_gradient;
  Increment increment = about_middle;
  increment.displacement_gradient =
      (Eigen::Matrix2d::Identity() - half).inverse() * about_middle.displacement_gradient;
  // x_middle = x_start + u / 2
  increment.configuration = Configuration::start;
  increment.curvature += 0.5 * increment.displacement_gradient.transpose() * about_middle.curvature;
  return increment;
}

Eigen::Vector2d rotated(const Eigen::Vector2d& vector, double angle) {
  const auto [sine, cosine] = sine_and_cosine(angle);
  return {cosine * vector.x() - sine * vector.y(), sine * vector.x() + cosine * vector.y()};
}

Vector7 rotated(const Vector7& stress, double angle) {
  const auto [sine, cosine] = sine_and_cosine(angle);
  Eigen::Matrix2d r, s;
  r << cosine, -sine, sine, cosine;
  s << stress(k11), stress(k12), stress(k21), stress(k22);
  s = r * s * r.transpose();
  Vector7 turned;
  turned << s(0, 0), s(1, 1), stress(k33), s(0, 1), s(1, 0), r * stress.tail<2>();
  return turned;
}

}  // namespace polargrain::fem
