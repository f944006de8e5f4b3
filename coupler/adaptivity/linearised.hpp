// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "common/increment.hpp"
#include "common/response.hpp"

namespace polargrain::coupler {

/// Increments that follow each other are not added: of displacement gradients (I + second)(I + first) = I + both;
/// a curvature counts per position at the start of its own increment, so that the second one is pulled back by
/// I + first; micro-rotations about one axis are added.
Increment followed_by(const Increment& first, const Increment& second);

/// The increment that leads from where `from` leads to where `to` leads.
Increment offset_between(const Increment& from, const Increment& to);

/// The increment with that displacement gradient, and no more.
Increment increment_of(const Eigen::Matrix2d& displacement_gradient);

/// What an answer of a cell becomes a little further on: s + C : e + (W s - s W), m + D : e + W m, with e the Cosserat
/// strain of the offset and W the skew part of its displacement gradient (docs/adaptivity.md, 1). Of cells with free
/// rotations stress and tangent are to be symmetric.
Vector7 linearised_stress(const Response& answer, const Increment& offset);

}  // namespace polargrain::coupler
