// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>

namespace polargrain::fem {

/// How far the insides of points are from rest, where points have insides that move (boxes of grains).
struct Unrest {
  double sum = 0.0;        ///< over the points, of the mean unbalanced force inside over the mean force there
  std::size_t points = 0;  ///< that have an inside
  std::size_t hot = 0;     ///< of them: it stays high, so that the stress is one of agitation too
};

}  // namespace polargrain::fem
