// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/box/box_motion.hpp"

#include <Eigen/LU>

#include "dem/box/rotation.hpp"

namespace polargrain::dem {

template <int dim>
RotationLoading<dim> RotationLoading<dim>::of(const Increment<dim>& increment) {
  if constexpr (dim == 2) {
    return {Rotation(increment.micro_rotation), increment.curvature.transpose()};
  } else {
    return {increment.rotation, increment.curvature};
  }
}

template <int dim>
typename RotationLoading<dim>::Rotation RotationLoading<dim>::against(const BoxPath<dim>& path) const {
  if constexpr (dim == 2) {
    return rotation - path.rotation();
  } else {
    return rotation_vector(rotation_by(path.rotation()).transpose() * rotation_by(rotation));
  }
}

template <int dim>
BoxMotion<dim>::BoxMotion(const BoxPath<dim>& path, const Loading& rotation, double time_step) {
  go_on(path, rotation, time_step);
}

template <int dim>
void BoxMotion<dim>::go_on(const BoxPath<dim>& path, const Loading& rotation, double time_step) {
  path_ = path;
  rotation_ = rotation;
  against_ = rotation ? rotation->against(path) : Rotation::Zero();
  box_ = before_ = path.at(0);
  stretched_frame_ = box_.frame();
  time_step_ = time_step;
  step_ = 0;
}

template <int dim>
void BoxMotion<dim>::set_rates(const Matrix& gradient, const Rotation& spin) {
  rate_ = gradient * box_.base;
  gradient_ = gradient;
  spin_ = spin;
}

template <int dim>
void BoxMotion<dim>::advance() {
  ++step_;
  before_ = box_;
  if (step_ > path_.steps() + 1) {  // at rest
    change_.setZero();
    change_of_spin_.setZero();
    curvature_rate_.setZero();
    moving_ = false;
    return;
  }
  if (step_ <= path_.steps()) box_ = path_.at(step_);
  const Matrix rate = (box_.base - before_.base) / time_step_;
  const Matrix inverse = before_.inverse();
  change_ = (rate - rate_) * inverse;
  rate_ = rate;
  gradient_ = rate_ * box_.inverse();
  turn_ = turn_between(before_, box_);
  const Rotation before_spin = spin_;
  curvature_rate_.setZero();
  if (rotation_)
    turn_grains();
  else
    spin_ = axial<dim>(rate * inverse);
  change_of_spin_ = spin_ - before_spin;
  moving_ = true;
}

template <int dim>
typename BoxMotion<dim>::Rotation BoxMotion<dim>::turn_between(const Box<dim>& before,
                                                               const Box<dim>& after) const {
  if constexpr (dim == 2) {
    return Rotation(after.orientation - before.orientation);
  } else {
    // Of a frame that stands still round-off would leave a turn.
    if (step_ > path_.steps()) return Rotation::Zero();
    return rotation_vector(after.orientation * before.orientation.transpose());
  }
}

template <>
void BoxMotion<2>::turn_grains() {
  const double share = path_.share(step_);
  spin_ = (rotation_->rotation * share - turn_) / time_step_;
  if (rotation_->curvature.isZero(0.0)) return;
  const Eigen::Vector2d rate = share / time_step_ *
                               (box_.frame().transpose() * path_.deformation(step_).inverse().transpose() *
                                rotation_->curvature.transpose());
  curvature_rate_ = rate.transpose();
}

template <>
void BoxMotion<3>::turn_grains() {
  // Grains and frame both turn with R(s w), so only what is left of either counts: v, and the frame that stretching alone
  // makes.
  const Eigen::Matrix3d before = stretched_frame_;
  stretched_frame_ = path_.turned(step_).transpose() * box_.orientation;
  const Eigen::Matrix3d to_box = stretched_frame_.transpose();
  const double rate = path_.share(step_) / time_step_;
  spin_ = to_box * (rate * against_ - rotation_vector(stretched_frame_ * before.transpose()) / time_step_);
  if (!rotation_->curvature.isZero(0.0))
    curvature_rate_ =
        rate * to_box * rotation_->curvature * path_.deformation(step_).inverse() * box_.orientation;
}

template struct RotationLoading<2>;
template struct RotationLoading<3>;
template class BoxMotion<2>;
template class BoxMotion<3>;

}  // namespace polargrain::dem
