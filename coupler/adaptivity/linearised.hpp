// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "common/increment.hpp"
#include "common/response.hpp"

namespace polargrain::coupler {

/// Displacement gradients that follow each other are not added: (I + second)(I + first) = I + both.
Eigen::Matrix2d followed_by(const Eigen::Matrix2d& first, const Eigen::Matrix2d& second);

/// The displacement gradient that leads from where `from` leads to where `to` leads.
Eigen::Matrix2d offset_between(const Eigen::Matrix2d& from, const Eigen::Matrix2d& to);

/// The increment of a cell with that displacement gradient, and no more.
Increment increment_of(const Eigen::Matrix2d& displacement_gradient);

/// What an answer of a cell becomes a little further on: s + C : e + (W s - s W), with e and W the symmetric
/// and the skew part of the offset (docs/adaptivity.md, 1). Stress and tangent of `answer` are symmetric.
Vector7 linearised_stress(const Response& answer, const Eigen::Matrix2d& offset);

/// sqrt(s11^2 + s22^2 + 2 s12^2) of the symmetric part of a stress: what an error in stress is measured by.
double in_plane_norm(const Vector7& stress);

}  // namespace polargrain::coupler
