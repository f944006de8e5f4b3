// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/box/lost_grains.hpp"

#include <cmath>

#include "common/error.hpp"

namespace polargrain::dem {

void lose_grains() {
  throw RunError(
      "Lost grains: the time step is too large for the stiffness of the contacts, or grains were pressed "
      "into each other");
}

std::int32_t copy_of(double boxes) {
  constexpr double kMostBoxes = 1e6;
  if (!(std::abs(boxes) < kMostBoxes)) lose_grains();
  return static_cast<std::int32_t>(std::floor(boxes));
}

}  // namespace polargrain::dem
