// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/increment.hpp"

namespace polargrain::coupler {

/// Increments that follow each other are not added: of displacement gradients (I + second)(I + first) = I + both;
/// a curvature counts per position at the start of its own increment, so that the second one is pulled back by
/// I + first; micro-rotations about one axis are added. The result is of large deformation where the last
/// increment is.
Increment<2> followed_by(const Increment<2>& first, const Increment<2>& second);

/// The increment that leads from where `from` leads to where `to` leads.
Increment<2> offset_between(const Increment<2>& from, const Increment<2>& to);

/// Where the first part of an increment of large deformation leads to, in which its turn and its stretch grow alike.
/// @param share 0 to 1
Increment<2> share_of(const Increment<2>& increment, double share);

}  // namespace polargrain::coupler
