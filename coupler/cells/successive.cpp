// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/successive.hpp"

#include <Eigen/LU>

#include "common/elementary_functions.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {

Increment<2> followed_by(const Increment<2>& first, const Increment<2>& second) {
  const Eigen::Matrix2d& h = first.displacement_gradient;
  Increment<2> both;
  both.displacement_gradient = h + second.displacement_gradient + second.displacement_gradient * h;
  both.micro_rotation = first.micro_rotation + second.micro_rotation;
  both.curvature = first.curvature + second.curvature + h.transpose() * second.curvature;
  both.configuration = second.configuration;
  return both;
}

Increment<2> offset_between(const Increment<2>& from, const Increment<2>& to) {
  const Eigen::Matrix2d back = (Eigen::Matrix2d::Identity() + from.displacement_gradient).inverse();
  Increment<2> offset;
  offset.displacement_gradient = (to.displacement_gradient - from.displacement_gradient) * back;
  offset.micro_rotation = to.micro_rotation - from.micro_rotation;
  offset.curvature = back.transpose() * (to.curvature - from.curvature);
  offset.configuration = to.configuration;
  return offset;
}

Increment<2> share_of(const Increment<2>& increment, double share) {
  const double angle = fem::rotation_angle(increment);
  const auto [sine, cosine] = sine_and_cosine(share * angle);
  const auto [whole_sine, whole_cosine] = sine_and_cosine(angle);
  Eigen::Matrix2d turn, back;
  turn << cosine, -sine, sine, cosine;
  back << whole_cosine, whole_sine, -whole_sine, whole_cosine;
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d strain = back * (one + increment.displacement_gradient) - one;  // U - I
  Increment<2> part = increment;
  part.displacement_gradient = turn * (one + share * strain) - one;
  part.micro_rotation *= share;
  part.curvature *= share;
  return part;
}

}  // namespace polargrain::coupler
