// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/adaptivity/linearised.hpp"

#include "fem/material/rotation.hpp"

namespace polargrain::coupler {

Increment<2> increment_of(const Eigen::Matrix2d& displacement_gradient) {
  Increment<2> increment;
  increment.displacement_gradient = displacement_gradient;
  return increment;
}

Vector7 linearised_stress(const Response<2>& answer, const Increment<2>& offset) {
  if (offset.configuration != Configuration::fixed) {
    const fem::StretchAndTurn<2> step = fem::stretch_and_turn(offset);
    return fem::rotated(Vector7(answer.stress + answer.tangent * step.stretch.strain()), step.turn);
  }
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

Response<2> with_tangent_turned(Response<2> answer, const Increment<2>& offset) {
  if (offset.configuration != Configuration::fixed)
    answer.tangent = fem::rotated(answer.tangent, fem::rotation_angle(offset));
  return answer;
}

}  // namespace polargrain::coupler
