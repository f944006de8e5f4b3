// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/increment.hpp"

namespace polargrain::fem {

/// Angle (rad, counter-clockwise) by which the material turns over an increment whose displacement gradient
/// refers to the middle of the step: exact for a rigid rotation of any size below pi (Hughes and Winget
/// 1980).
double rotation_angle(const Increment& increment);

/// The same increment with its gradients about the start of the step instead of the middle:
/// I + h_start = (I - h/2)^-1 (I + h/2), which turns rigidly when the middle sees a rigid rotation.
Increment about_start(const Increment& about_middle);

/// A vector of the plane turned by an angle.
Eigen::Vector2d rotated(const Eigen::Vector2d& vector, double angle);

/// A stress vector (order of common/increment.hpp) turned with the material: s' = R s R^T, m' = R m.
Vector7 rotated(const Vector7& stress, double angle);

}  // namespace polargrain::fem
