// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/spheres/space_box.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "common/elementary_functions.hpp"
#include "common/error.hpp"
#include "dem/spheres/rotation.hpp"

namespace polargrain::dem {

SpaceBox SpaceBox::from_base_vectors(const Eigen::Matrix3d& base_vectors) {
  const TriangularParts parts = triangular_parts(base_vectors);
  return {parts.triangular, parts.rotation};
}

Eigen::Matrix3d SpaceBox::inverse() const {
  Eigen::Matrix3d made = Eigen::Matrix3d::Zero();
  for (int axis = 0; axis < 3; ++axis) made(axis, axis) = 1.0 / base(axis, axis);
  made(0, 1) = -base(0, 1) * made(0, 0) * made(1, 1);
  made(1, 2) = -base(1, 2) * made(1, 1) * made(2, 2);
  made(0, 2) = (base(0, 1) * base(1, 2) - base(0, 2) * base(1, 1)) * made(0, 0) * made(1, 1) * made(2, 2);
  return made;
}

SpaceBox SpaceBox::reduced() const {
  SpaceBox box = *this;
  // The tilt against the second base vector first: taking it off changes the one against the first.
  box.base.col(2) -= std::round(box.base(1, 2) / box.base(1, 1)) * box.base.col(1);
  box.base.col(2) -= std::round(box.base(0, 2) / box.base(0, 0)) * box.base.col(0);
  box.base.col(1) -= std::round(box.base(0, 1) / box.base(0, 0)) * box.base.col(0);
  return box;
}

Eigen::Vector3d SpaceBox::folded(Eigen::Vector3d place) const {
  // Along the third base vector first: the others have nothing of what it folds.
  for (int axis = 2; axis >= 0; --axis) {
    const Eigen::Vector3d part = inverse() * place;
    place -= std::floor(part(axis)) * base.col(axis);
  }
  return place;
}

SpacePath::SpacePath(const SpaceBox& start, const Eigen::Matrix3d& displacement_gradient, int steps,
                     Pace pace)
    : start_(start), steps_(steps), pace_(pace) {
  const Eigen::Matrix3d whole = Eigen::Matrix3d::Identity() + displacement_gradient;
  // The determinant is a cubic in the fraction; a fold shows at the end or on the way.
  for (int part = 1; part <= 16; ++part) {
    const Eigen::Matrix3d now = Eigen::Matrix3d::Identity() + part / 16.0 * displacement_gradient;
    if (!(now.determinant() > 1e-3))
      throw RunError("the increment folds the cell: its box would lose its volume");
  }
  const Eigen::Matrix3d turn = rotation_of(whole);
  rotation_ = rotation_vector(turn);
  const Eigen::Matrix3d stretch = turn.transpose() * whole - Eigen::Matrix3d::Identity();
  stretch_ = 0.5 * (stretch + stretch.transpose());
  stretch_of_base_ = start.frame.transpose() * stretch_ * start.frame * start.base;
}

SpacePath SpacePath::straight(const SpaceBox& start, const Eigen::Matrix3d& gradient, int steps) {
  SpacePath path;
  path.start_ = start;
  path.stretch_of_base_ = gradient * start.base;
  path.steps_ = steps;
  path.straight_ = true;
  return path;
}

double SpacePath::fraction(int step) const {
  if (step <= 0) return 0.0;
  if (step >= steps_) return 1.0;
  const double time = static_cast<double>(step) / steps_;
  if (pace_ == Pace::even) return time;
  return time - sine(2.0 * std::numbers::pi * time) / (2.0 * std::numbers::pi);
}

double SpacePath::share(int step) const {
  return step < 1 || step > steps_ ? 0.0 : fraction(step) - fraction(step - 1);
}

Eigen::Matrix3d SpacePath::deformation(int step) const {
  return turned(step) * (Eigen::Matrix3d::Identity() + fraction(step) * stretch_);
}

Eigen::Matrix3d SpacePath::turned(int step) const {
  return rotation_by(fraction(step) * rotation_);
}

SpaceBox SpacePath::at(int step) const {
  if (step <= 0 || steps_ == 0) return start_;
  const double part = fraction(step);
  if (straight_) return {start_.base + part * stretch_of_base_, start_.frame};
  const SpaceBox stretched = SpaceBox::from_base_vectors(start_.base + part * stretch_of_base_);
  return {stretched.base, rotation_by(part * rotation_) * start_.frame * stretched.frame};
}

double largest_principal_strain(const SpacePath& path) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(path.strain(), Eigen::EigenvaluesOnly)
      .eigenvalues()
      .cwiseAbs()
      .maxCoeff();
}

Eigen::Vector3d SpaceRotation::against(const SpacePath& path) const {
  return rotation_vector(rotation_by(path.rotation()).transpose() * rotation_by(rotation));
}

SpaceMotion::SpaceMotion(const SpacePath& path, const std::optional<SpaceRotation>& rotation,
                         double time_step)
    : path_(path), rotation_(rotation), time_step_(time_step), box_(path.at(0)) {
  if (rotation) against_ = rotation->against(path);
  stretched_frame_ = box_.frame;
}

void SpaceMotion::go_on(const SpacePath& path, const std::optional<SpaceRotation>& rotation,
                        double time_step) {
  path_ = path;
  rotation_ = rotation;
  against_ = rotation ? rotation->against(path) : Eigen::Vector3d::Zero();
  box_ = path.at(0);
  stretched_frame_ = box_.frame;
  time_step_ = time_step;
  step_ = 0;
}

void SpaceMotion::set_rates(const Eigen::Matrix3d& gradient, const Eigen::Vector3d& spin) {
  rate_ = gradient * box_.base;
  gradient_ = gradient;
  spin_ = spin;
}

void SpaceMotion::advance() {
  ++step_;
  if (step_ > path_.steps() + 1) {  // at rest
    change_.setZero();
    change_of_spin_.setZero();
    curvature_rate_.setZero();
    moving_ = false;
    return;
  }
  const SpaceBox before = box_;
  if (step_ <= path_.steps()) box_ = path_.at(step_);
  const Eigen::Matrix3d rate = (box_.base - before.base) / time_step_;
  const Eigen::Matrix3d inverse = before.inverse();
  change_ = (rate - rate_) * inverse;
  rate_ = rate;
  gradient_ = rate_ * box_.inverse();
  turn_.setZero();
  if (step_ <= path_.steps()) turn_ = rotation_vector(box_.frame * before.frame.transpose());
  const Eigen::Vector3d before_spin = spin_;
  if (rotation_)
    turn_grains();
  else
    spin_ = axial(rate * inverse);
  change_of_spin_ = spin_ - before_spin;
  moving_ = true;
}

void SpaceMotion::turn_grains() {
  // Grains and frame both turn with R(s w), so only what is left of either counts: v, and the frame that stretching alone
  // makes.
  const Eigen::Matrix3d before = stretched_frame_;
  stretched_frame_ = path_.turned(step_).transpose() * box_.frame;
  const Eigen::Matrix3d to_box = stretched_frame_.transpose();
  const double rate = path_.share(step_) / time_step_;
  spin_ = to_box * (rate * against_ - rotation_vector(stretched_frame_ * before.transpose()) / time_step_);
  curvature_rate_.setZero();
  if (!rotation_->curvature.isZero(0.0))
    curvature_rate_ = rate * to_box * rotation_->curvature * path_.deformation(step_).inverse() * box_.frame;
}

}  // namespace polargrain::dem
