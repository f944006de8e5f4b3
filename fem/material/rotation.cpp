// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/rotation.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace polargrain::fem {

double rotation_angle(const Increment& increment) {
  const Eigen::Matrix2d& h = increment.displacement_gradient;
  return 2.0 * std::atan(0.25 * (h(1, 0) - h(0, 1)));
}

Vector7 rotated(const Vector7& stress, double angle) {
  const Eigen::Matrix2d r = Eigen::Rotation2Dd(angle).toRotationMatrix();
  Eigen::Matrix2d s;
  s << stress(k11), stress(k12), stress(k21), stress(k22);
  s = r * s * r.transpose();
  Vector7 turned;
  turned << s(0, 0), s(1, 1), stress(k33), s(0, 1), s(1, 0), r * stress.tail<2>();
  return turned;
}

}  // namespace polargrain::fem
