// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/adaptivity/linearised.hpp"

#include <Eigen/LU>
#include <cmath>

namespace polargrain::coupler {

Eigen::Matrix2d followed_by(const Eigen::Matrix2d& first, const Eigen::Matrix2d& second) {
  return first + second + second * first;
}

Eigen::Matrix2d offset_between(const Eigen::Matrix2d& from, const Eigen::Matrix2d& to) {
  return (to - from) * (Eigen::Matrix2d::Identity() + from).inverse();
}

Increment increment_of(const Eigen::Matrix2d& displacement_gradient) {
  Increment increment;
  increment.displacement_gradient = displacement_gradient;
  return increment;
}

Vector7 linearised_stress(const Response& answer, const Eigen::Matrix2d& offset) {
  Vector7 stress = answer.stress + answer.tangent * increment_of(offset).strain();
  const double turn = 0.5 * (offset(1, 0) - offset(0, 1));
  const double shear = answer.stress[k12];
  stress[k11] -= 2.0 * turn * shear;
  stress[k22] += 2.0 * turn * shear;
  const double difference = turn * (answer.stress[k11] - answer.stress[k22]);
  stress[k12] += difference;
  stress[k21] += difference;
  return stress;
}

double in_plane_norm(const Vector7& stress) {
  const double shear = 0.5 * (stress[k12] + stress[k21]);
  return std::sqrt(stress[k11] * stress[k11] + stress[k22] * stress[k22] + 2.0 * shear * shear);
}

}  // namespace polargrain::coupler
