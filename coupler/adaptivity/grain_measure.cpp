// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/adaptivity/grain_measure.hpp"

#include <cmath>

#include "coupler/cells/cosserat_part.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

/// Weight of a volume change; the square root of its share of the curvature of the response in shear.
constexpr double kVolume = 0.35;

}  // namespace

Vector7 GrainMeasure::strain(const Increment<2>& increment) const {
  Vector7 strain = fem::stretch_and_turn(increment).stretch.strain();
  if (!controlled()) return symmetric_part(strain);
  strain.tail<2>() *= diameter_;
  return strain;
}

Vector7 GrainMeasure::unmeasured(const Vector7& strain) const {
  Vector7 plain = strain;
  if (controlled()) plain.tail<2>() /= diameter_;
  return plain;
}

double GrainMeasure::size(const Increment<2>& offset) const {
  Vector7 deviator = strain(offset);
  const double volume = 0.5 * (deviator[k11] + deviator[k22]);
  deviator[k11] -= volume;
  deviator[k22] -= volume;
  return std::sqrt(deviator.squaredNorm() + 2.0 * kVolume * kVolume * volume * volume);
}

double GrainMeasure::stress(const Vector7& stress) const {
  const double shear = 0.5 * (stress[k12] + stress[k21]);
  double squared = stress[k11] * stress[k11] + stress[k22] * stress[k22] + 2.0 * shear * shear;
  if (controlled()) {
    const double skew = 0.5 * (stress[k21] - stress[k12]);
    squared += 2.0 * skew * skew + stress.tail<2>().squaredNorm() / (diameter_ * diameter_);
  }
  return std::sqrt(squared);
}

}  // namespace polargrain::coupler
