// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/adaptivity/linearised.hpp"

#include <Eigen/LU>

namespace polargrain::coupler {

Increment followed_by(const Increment& first, const Increment& second) {
  const Eigen::Matrix2d& h = first.displacement_gradient;
  Increment both;
  both.displacement_gradient = h + second.displacement_gradient + second.displacement_gradient * h;
  both.micro_rotation = first.micro_rotation + second.micro_rotation;
  both.curvature = first.curvature + second.curvature + h.transpose() * second.curvature;
  return both;
}

Increment offset_between(const Increment& from, const Increment& to) {
  const Eigen::Matrix2d back = (Eigen::Matrix2d::Identity() + from.displacement_gradient).inverse();
  Increment offset;
  offset.displacement_gradient = (to.displacement_gradient - from.displacement_gradient) * back;
  offset.micro_rotation = to.micro_rotation - from.micro_rotation;
  offset.curvature = back.transpose() * (to.curvature - from.curvature);
  return offset;
}

Increment increment_of(const Eigen::Matrix2d& displacement_gradient) {
  Increment increment;
  increment.displacement_gradient = displacement_gradient;
  return increment;
}

Vector7 linearised_stress(const Response& answer, const Increment& offset) {
  Vector7 stress = answer.stress + answer.tangent * offset.strain();
  const Eigen::Matrix2d& h = offset.displacement_gradient;
  const double turn = 0.5 * (h(1, 0) - h(0, 1));
  const double shear = 0.5 * (answer.stress[k12] + answer.stress[k21]);
  stress[k11] -= 2.0 * turn * shear;
  stress[k22] += 2.0 * turn * shear;
  const double difference = turn * (answer.stress[k11] - answer.stress[k22]);
  stress[k12] += difference;
  stress[k21] += difference;
  stress[kCurvature1] -= turn * answer.stress[kCurvature2];
  stress[kCurvature2] += turn * answer.stress[kCurvature1];
  return stress;
}

}  // namespace polargrain::coupler
