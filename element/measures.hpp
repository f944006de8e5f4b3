// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "element/material_point.hpp"

namespace polargrain::element {

/// The measures of soil mechanics for a stress. Compression is positive. Of discs, which have no third stress, those of the
/// plane: p = (s1 + s2) / 2, q = s1 - s2, b is NaN.
struct StressMeasures {
  double p = 0.0;        ///< mean stress, Pa
  double q = 0.0;        ///< sqrt(3 J2), Pa; negative where the axial stress is below the lateral ones
  double largest = 0.0;  ///< principal stress, Pa
  double least = 0.0;    ///< the same
  double ratio = 1.0;    ///< largest over least principal stress; infinity where the least is not compressive
  double friction_angle =
      0.0;         ///< mobilised: asin((s1 - s3) / (s1 + s3)), rad; NaN where the least is not compressive
  double b = 0.0;  ///< (s2 - s3) / (s1 - s3); NaN under isotropic stress
};

/// @param stress in the order of Place, tension positive
StressMeasures measures_of(const Vector6& stress, Room room);

}  // namespace polargrain::element
