// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "common/increment.hpp"

namespace polargrain::fem {

/// Measures of a stress for engineers, all from its symmetric part: s12 and s21 enter by their mean, couple stresses
/// do not. Tension is positive but for the pressure.
struct StressMeasures {
  double pressure = 0.0;    ///< p = -(s11 + s22 + s33) / 3, Pa, positive in compression
  double deviatoric = 0.0;  ///< q = sqrt(3/2 s_ij s_ij) with s the deviator, Pa
  double ratio = 0.0;       ///< q / p; 0 where p is not positive
  /// Principal stresses, Pa: in the plane the most compressive and the least, then s33.
  Eigen::Vector3d principal = Eigen::Vector3d::Zero();
  /// Unit vectors of the first and the second, the first with a positive component along 1 (or along 2 alone), the second a
  /// quarter turn on, counter-clockwise. Of equal stresses: along 1 and 2.
  Eigen::Vector2d first_direction = Eigen::Vector2d::UnitX();
  Eigen::Vector2d second_direction = Eigen::Vector2d::UnitY();
  /// Angle of friction that the stresses in the plane ask for, degrees: sin = (second - first) / -(first + second) of the
  /// principal ones; 0 where there is no compression, 90 where one of them is tensile.
  double mobilised_friction = 0.0;
};

/// @param stress s11, s22, s33, s12, s21, m1, m2
StressMeasures measures_of(const Vector7& stress);

/// The same in space.
struct SpaceStressMeasures {
  double pressure = 0.0;    ///< p, Pa, positive in compression
  double deviatoric = 0.0;  ///< q, Pa
  double ratio = 0.0;       ///< q / p; 0 where p is not positive
  /// Principal stresses, Pa, the most compressive first, and their directions, a column each, unit vectors.
  Eigen::Vector3d principal = Eigen::Vector3d::Zero();
  Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();
  /// Degrees, from 0 in triaxial compression (the two less compressive stresses equal) to 60 in extension; 0 without a
  /// deviator.
  double lode_angle = 0.0;
  double mobilised_friction = 0.0;  ///< of the first and the last principal stress, degrees
};

/// Of a stress in the order of Cosserat<3>.
SpaceStressMeasures measures_in_space(const Vector18& stress);

}  // namespace polargrain::fem
