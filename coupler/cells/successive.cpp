// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/successive.hpp"

#include <Eigen/LU>
#include <cmath>

#include "common/elementary_functions.hpp"
#include "coupler/cells/cell_increment.hpp"
#include "fem/material/polar_decomposition.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

/// Rotations of large deformation in space are rotations; in small deformation they are small, and add up as in the plane.
bool are_rotations(const Increment<3>& increment) {
  return increment.configuration != Configuration::fixed;
}

/// The curvature of the second of two increments as the start of the first sees it. @param f I + h of the first
Eigen::Vector2d pulled_back(const Eigen::Vector2d& curvature, const Eigen::Matrix2d& f) {
  return f.transpose() * curvature;
}
Eigen::Matrix3d pulled_back(const Eigen::Matrix3d& curvature, const Eigen::Matrix3d& f) {
  return curvature * f;
}

}  // namespace

double turn_of(const Increment<2>& increment) {
  return std::abs(fem::rotation_angle(increment));
}

double turn_of(const Increment<3>& increment) {
  return fem::rotation_vector(increment).norm();
}

template <int dim>
Increment<dim> followed_by(const Increment<dim>& first, const Increment<dim>& second) {
  const auto& h = first.displacement_gradient;
  Increment<dim> both;
  both.displacement_gradient = h + second.displacement_gradient + second.displacement_gradient * h;
  micro_rotation(both) = micro_rotation(first) + micro_rotation(second);
  if constexpr (dim == 2) {
    both.curvature = first.curvature + second.curvature + h.transpose() * second.curvature;
  } else {
    if (are_rotations(second))
      both.rotation = fem::vector_of(fem::rotation_by(second.rotation) * fem::rotation_by(first.rotation));
    both.curvature = first.curvature + second.curvature + second.curvature * h;
  }
  both.configuration = second.configuration;
  return both;
}

template <int dim>
Increment<dim> offset_between(const Increment<dim>& from, const Increment<dim>& to) {
  using Gradient = typename Cosserat<dim>::Gradient;
  const Gradient back = (Gradient::Identity() + from.displacement_gradient).inverse();
  Increment<dim> offset;
  offset.displacement_gradient = (to.displacement_gradient - from.displacement_gradient) * back;
  micro_rotation(offset) = micro_rotation(to) - micro_rotation(from);
  if constexpr (dim == 3) {
    if (are_rotations(to) && to.rotation != from.rotation)  // else exactly zero
      offset.rotation =
          fem::vector_of(fem::rotation_by(to.rotation) * fem::rotation_by(from.rotation).transpose());
  }
  offset.curvature = pulled_back((to.curvature - from.curvature).eval(), back);
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

Increment<3> share_of(const Increment<3>& increment, double share) {
  const fem::PolarDecomposition parts(increment.displacement_gradient);
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  Increment<3> part = increment;
  part.displacement_gradient =
      fem::rotation_by(share * parts.vector) * (one + share * (parts.stretch - one)) - one;
  part.rotation *= share;
  part.curvature *= share;
  return part;
}

template Increment<2> followed_by(const Increment<2>&, const Increment<2>&);
template Increment<3> followed_by(const Increment<3>&, const Increment<3>&);
template Increment<2> offset_between(const Increment<2>&, const Increment<2>&);
template Increment<3> offset_between(const Increment<3>&, const Increment<3>&);

}  // namespace polargrain::coupler
