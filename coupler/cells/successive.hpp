// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/increment.hpp"

namespace polargrain::coupler {

/// Increments that follow each other are not added: of displacement gradients (I + second)(I + first) = I + both;
/// a curvature counts per position at the start of its own increment, so that the second one is pulled back by
/// I + first; micro-rotations about one axis are added, and in space, in large deformation, follow each other as rotations.
/// The result is of large deformation where the last increment is.
template <int dim>
Increment<dim> followed_by(const Increment<dim>& first, const Increment<dim>& second);

/// The increment that leads from where `from` leads to where `to` leads.
template <int dim>
Increment<dim> offset_between(const Increment<dim>& from, const Increment<dim>& to);

/// Where the first part of an increment of large deformation leads to, in which its turn and its stretch grow alike.
/// @param share 0 to 1
Increment<2> share_of(const Increment<2>& increment, double share);
Increment<3> share_of(const Increment<3>& increment, double share);

/// The rotation of an increment of large deformation in its polar decomposition, rad: its size.
double turn_of(const Increment<2>& increment);
double turn_of(const Increment<3>& increment);

}  // namespace polargrain::coupler
