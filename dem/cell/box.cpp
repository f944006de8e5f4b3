// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/box.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "common/error.hpp"

namespace polargrain::dem {

Box Box::from_base_vectors(const Eigen::Matrix2d& base_vectors) {
  const Eigen::Vector2d first = base_vectors.col(0);
  Box box;
  box.length_x = first.norm();
  box.tilt = first.dot(base_vectors.col(1)) / box.length_x;
  box.length_y = base_vectors.determinant() / box.length_x;
  box.rotation = std::atan2(first.y(), first.x());
  return box;
}

Eigen::Matrix2d Box::base_vectors() const {
  Eigen::Matrix2d base;
  base << length_x, tilt, 0.0, length_y;
  return base;
}

Eigen::Matrix2d Box::frame() const {
  Eigen::Matrix2d turn;
  turn << std::cos(rotation), -std::sin(rotation), std::sin(rotation), std::cos(rotation);
  return turn;
}

Box Box::reduced() const {
  Box box = *this;
  box.tilt -= length_x * std::round(tilt / length_x);
  return box;
}

BoxPath::BoxPath(const Box& start, const Eigen::Matrix2d& displacement_gradient, int steps)
    : start_(start), displacement_gradient_(displacement_gradient), steps_(steps) {
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
  return time - std::sin(2.0 * std::numbers::pi * time) / (2.0 * std::numbers::pi);
}

double BoxPath::share(int step) const {
  return step < 1 || step > steps_ ? 0.0 : fraction(step) - fraction(step - 1);
}

Box BoxPath::at(int step) const {
  if (step <= 0) return start_;
  const Eigen::Matrix2d carried =
      start_.base_vectors() + fraction(step) * (start_.frame().transpose() * displacement_gradient_ *
                                                start_.frame() * start_.base_vectors());
  Box box = Box::from_base_vectors(carried);
  box.rotation += start_.rotation;
  return box;
}

BoxPath::Motion BoxPath::motion(int step) const {
  Motion motion;
  if (step < 1 || step > steps_) return motion;
  const Box before = at(step - 1);
  const Box after = at(step);
  motion.gradient = (after.base_vectors() - before.base_vectors()) *
                    before.base_vectors().triangularView<Eigen::Upper>().solve(Eigen::Matrix2d::Identity());
  motion.rotation = after.rotation - before.rotation;
  return motion;
}

}  // namespace polargrain::dem
