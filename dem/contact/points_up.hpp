// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace polargrain::dem {

/// A grain that touches its own image across a periodic face meets it on both sides; this is true on one of them.
/// @param delta three numbers: from the image to the grain
inline bool points_up(const double* delta) {
  if (delta[1] != 0.0) return delta[1] > 0.0;
  return delta[0] > 0.0 || (delta[0] == 0.0 && delta[2] > 0.0);
}

}  // namespace polargrain::dem
