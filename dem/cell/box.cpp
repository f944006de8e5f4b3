// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/box.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "common/elementary_functions.hpp"
#include "common/error.hpp"

namespace polargrain::dem {

namespace {
Eigen::Matrix2d turn(double angle) {
  const auto [sine, cosine] = sine_and_cosine(angle);
  Eigen::Matrix2d matrix;
  matrix << cosine, -sine, sine, cosine;
  return matrix;
}
}  // namespace

Box Box::from_base_vectors(const Eigen::Matrix2d& base_vectors) {
  const Eigen::Vector2d first = base_vectors.col(0);
  Box box;
  box.length_x = first.norm();
  box.tilt = first.dot(base_vectors.col(1)) / box.length_x;
  box.length_y = base_vectors.determinant() / box.length_x;
  box.rotation = arc_tangent(first.y(), first.x());
  return box;
}

Eigen::Matrix2d Box::base_vectors() const {
  Eigen::Matrix2d base;
  base << length_x, tilt, 0.0, length_y;
  return base;
}

Eigen::Matrix2d Box::frame() const {
  return turn(rotation);
}

Box Box::reduced() const {
  Box box = *this;
  box.tilt -= length_x * std::round(tilt / length_x);
  return box;
}

Eigen::Vector2d Box::folded(Eigen::Vector2d place) const {
  // Along the second base vector first: the other has nothing of what it folds.
  const double layer = std::floor(place.y() / length_y);
  place.y() -= layer * length_y;
  place.x() -= layer * tilt;
  place.x() -= length_x * std::floor((place.x() - place.y() * tilt / length_y) / length_x);
  return place;
}

BoxPath::BoxPath(const Box& start, const Eigen::Matrix2d& displacement_gradient, int steps, Pace pace)
    : start_(start), steps_(steps), pace_(pace) {
  const Eigen::Matrix2d whole = Eigen::Matrix2d::Identity() + displacement_gradient;
  // In the plane R has the direction of the part of I + h that is a rotation times a number.
  rotation_ = arc_tangent(whole(1, 0) - whole(0, 1), whole.trace());
  stretch_ = turn(-rotation_) * whole - Eigen::Matrix2d::Identity();
  // The determinant is a parabola in the fraction; a fold shows at the end or on the way.
  for (int part = 1; part <= 16; ++part) {
    const Eigen::Matrix2d now = Eigen::Matrix2d::Identity() + part / 16.0 * displacement_gradient;
    if (!(now.determinant() > 1e-3))
      throw RunError("the increment folds the cell: its box would lose its area");
  }
}

double BoxPath::fraction(int step) const {
  if (step <= 0) return 0.0;
  if (step >= steps_) return 1.0;
  const double time = static_cast<double>(step) / steps_;
  if (pace_ == Pace::even) return time;
  return time - sine(2.0 * std::numbers::pi * time) / (2.0 * std::numbers::pi);
}

double BoxPath::share(int step) const {
  return step < 1 || step > steps_ ? 0.0 : fraction(step) - fraction(step - 1);
}

Eigen::Matrix2d BoxPath::deformation(int step) const {
  const double part = fraction(step);
  return turn(part * rotation_) * (Eigen::Matrix2d::Identity() + part * stretch_);
}

Box BoxPath::at(int step) const {
  if (step <= 0) return start_;
  const double part = fraction(step);
  const Eigen::Matrix2d base = start_.base_vectors();
  const Eigen::Matrix2d stretched =
      base + part * (start_.frame().transpose() * stretch_ * start_.frame() * base);
  Box box = Box::from_base_vectors(stretched);
  box.rotation += start_.rotation + part * rotation_;
  return box;
}

}  // namespace polargrain::dem
