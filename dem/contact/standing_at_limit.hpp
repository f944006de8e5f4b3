// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace polargrain::dem {

/// A spring whose force is this share of its limit has no dashpot. One that was cut in the last step must not be
/// found below its limit by round-off when the next run begins.
inline constexpr double kStandingAtLimit = 1.0 - 1e-8;

}  // namespace polargrain::dem
