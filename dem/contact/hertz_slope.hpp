// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace polargrain::dem {

/// d force / d overlap of Hertz's normal force over force / overlap: it grows with the power 3/2 of the overlap.
inline constexpr double kHertzSlope = 1.5;

}  // namespace polargrain::dem
