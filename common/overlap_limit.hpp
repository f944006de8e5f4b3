// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace polargrain {

/// Mean overlap over the smaller radius beyond which contacts are soft for a stress: a packing at rest is refused, a run
/// says so. packing400 has 0.006 at 100 kPa; this is about eight times that pressure.
inline constexpr double kMostMeanOverlap = 0.05;

}  // namespace polargrain
