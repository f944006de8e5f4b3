// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/adaptivity/error_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/adaptivity/linearised.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

/// Of the stress between the tangents of sliding and of sticking contacts, what a change of direction was
/// measured to make (docs/adaptivity.md, 2).
constexpr double kShareOfElastic = 0.5;
/// The errors that a cell has shown are forgotten by half at each new run.
constexpr double kMemory = 0.5;

/// How far a strain goes on along the last loading.
double onward_of(const Vector7& strain, const Departure& departure) {
  return std::max(0.0, strain.dot(departure.direction));
}

}  // namespace

double Departure::over(double size) const {
  const double x = size / length;
  return error * (x <= 1.0 ? x * std::sqrt(x) : x * x);
}

double ErrorEstimate::of(const Response<2>& answer, const Departure& departure,
                         const Increment<2>& offset) const {
  const double size = measure_.size(offset);
  if (size == 0.0) return 0.0;
  if (!departure.known()) return HUGE_VAL;
  const Vector7 strain = measure_.strain(offset);
  const Vector7 onward = onward_of(strain, departure) * departure.direction;
  const Vector7 apart = (elastic_ - answer.tangent) * measure_.unmeasured(strain - onward);
  return departure.over(size) + kShareOfElastic * measure_.stress(apart);
}

double ErrorEstimate::onward(const Departure& departure, const Increment<2>& offset) const {
  return onward_of(measure_.strain(offset), departure);
}

double ErrorEstimate::of_history(const Response<2>& answer, const Departure& departure,
                                 const Excursion& point, const Excursion& cell) const {
  // Two that have not turned back differ in their places alone, which is no matter of history.
  const double missed = std::min(std::abs(point.depth - cell.depth), std::max(point.back, cell.back));
  if (missed == 0.0) return 0.0;
  const Vector7 apart = (elastic_ - answer.tangent) * measure_.unmeasured(missed * departure.direction);
  return kShareOfElastic * measure_.stress(apart);
}

Departure ErrorEstimate::learn(const Response<2>& start, const Response<2>& end, const Increment<2>& offset,
                               Departure& at_start) const {
  const double size = measure_.size(offset);
  const Vector7 strain = measure_.strain(offset);
  const double missed = measure_.stress(end.stress - linearised_stress(start, offset));
  Departure seen;
  // The tangent may have changed more than the stress shows. In large deformation all is compared in the axes of the end.
  const bool turns = offset.configuration != Configuration::fixed;
  const Vector7 along = turns ? fem::rotated(strain, fem::rotation_angle(offset)) : strain;
  const Matrix7 before = with_tangent_turned(start, offset).tangent;
  seen.error = std::max(missed, 0.5 * measure_.stress((end.tangent - before) * measure_.unmeasured(along)));
  seen.length = size;
  if (along.norm() > 0.0) seen.direction = along / along.norm();
  const bool replaces = !at_start.known() || (at_start.length < noise_length_ && size > at_start.length);
  const double expected = replaces ? 0.0 : at_start.over(size);
  seen.error = std::max(seen.error, kMemory * expected);
  if (replaces || missed > expected) {
    at_start.error = missed;
    at_start.length = size;
  }
  return seen;
}

}  // namespace polargrain::coupler
