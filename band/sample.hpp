// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace polargrain::band {

/// The change at one place of a body in an increment: a grain, or a finite element.
struct Sample {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  double area = 0.0;                                   ///< that the place stands for, m^2, > 0
  /// Greatest engineering shear strain of the increment, >= 0: see shear_strain().
  double shear = 0.0;
  double volume_strain = 0.0;  ///< of the increment, dilation positive
  double rotation = 0.0;       ///< of the grain, or micro-rotation, in the increment, rad, counter-clockwise
};

using Samples = std::vector<Sample>;

/// sqrt((h11 - h22)^2 + (h12 + h21)^2): difference of the in-plane principal strains.
/// @param gradient hij = d u_i / d x_j
inline double shear_strain(const Eigen::Matrix2d& gradient) {
  return std::hypot(gradient(0, 0) - gradient(1, 1), gradient(0, 1) + gradient(1, 0));
}

}  // namespace polargrain::band
