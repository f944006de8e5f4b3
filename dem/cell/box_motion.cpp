// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/box_motion.hpp"

#include <Eigen/LU>
#include <utility>

namespace polargrain::dem {

namespace {

/// H^-1 of the base vectors of a box, which are upper triangular.
Eigen::Matrix2d inverse(const Box& box) {
  Eigen::Matrix2d made;
  made << 1.0 / box.length_x, -box.tilt / (box.length_x * box.length_y), 0.0, 1.0 / box.length_y;
  return made;
}

}  // namespace

BoxMotion::BoxMotion(const BoxPath& path, std::optional<RotationLoading> rotation, double time_step)
    : path_(path), rotation_(std::move(rotation)), time_step_(time_step), box_(path.at(0)), before_(box_) {}

void BoxMotion::go_on(const BoxPath& path, std::optional<RotationLoading> rotation) {
  path_ = path;
  rotation_ = std::move(rotation);
  box_ = before_ = path.at(0);
  step_ = 0;
}

void BoxMotion::set_rates(const Eigen::Matrix2d& gradient, double spin) {
  rate_ = gradient * box_.base_vectors();
  gradient_ = gradient;
  spin_ = spin;
}

Eigen::Matrix2d BoxMotion::gradient_before() const {
  return rate_ * inverse(before_);
}

Eigen::Vector2d BoxMotion::find_curvature_rate() const {
  if (!rotation_ || rotation_->curvature.isZero(0.0)) return Eigen::Vector2d::Zero();
  return path_.share(step_) / time_step_ *
         (box_.frame().transpose() * path_.deformation(step_).inverse().transpose() * rotation_->curvature);
}

void BoxMotion::advance() {
  ++step_;
  before_ = box_;
  if (step_ > path_.steps() + 1) {  // at rest
    if (step_ > path_.steps() + 2) return;
    change_.setZero();
    change_of_spin_ = 0.0;
    moving_ = false;
    return;
  }
  if (step_ <= path_.steps()) box_ = path_.at(step_);
  const Eigen::Matrix2d rate = (box_.base_vectors() - before_.base_vectors()) / time_step_;
  change_ = (rate - rate_) * inverse(before_);
  rate_ = rate;
  gradient_ = rate_ * inverse(box_);
  turn_ = box_.rotation - before_.rotation;
  const Eigen::Matrix2d gradient = gradient_before();
  // Of the continuum, or the prescribed one.
  const double spin = rotation_ ? (rotation_->micro_rotation * path_.share(step_) - turn_) / time_step_
                                : 0.5 * (gradient(1, 0) - gradient(0, 1));
  change_of_spin_ = spin - spin_;
  spin_ = spin;
  curvature_rate_ = find_curvature_rate();
  moving_ = true;
}

}  // namespace polargrain::dem
