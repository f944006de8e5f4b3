// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/adaptivity/error_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/cells/linearised.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

/// Of the stress between the tangents of sliding and of sticking contacts, what a change of direction was
/// measured to make (docs/adaptivity.md, 2).
constexpr double kShareOfElastic = 0.5;
/// The errors that a cell has shown are forgotten by half at each new run.
constexpr double kMemory = 0.5;

/// How far a strain goes on along the last loading.
template <int dim>
double onward_of(const typename Cosserat<dim>::Vector& strain, const Departure<dim>& departure) {
  return std::max(0.0, strain.dot(departure.direction));
}

}  // namespace

template <int dim>
double Departure<dim>::over(double size) const {
  const double x = size / length;
  return error * (x <= 1.0 ? x * std::sqrt(x) : x * x);
}

template <int dim>
double ErrorEstimate<dim>::of(const Response<dim>& answer, const Departure<dim>& departure,
                              const Increment<dim>& offset) const {
  const double size = measure_.size(offset);
  if (size == 0.0) return 0.0;
  if (!departure.known()) return HUGE_VAL;
  const Vector strain = measure_.strain(offset);
  const Vector onward = onward_of<dim>(strain, departure) * departure.direction;
  const Vector apart = (elastic_ - answer.tangent) * measure_.unmeasured(strain - onward);
  return departure.over(size) + kShareOfElastic * measure_.stress(apart);
}

template <int dim>
double ErrorEstimate<dim>::onward(const Departure<dim>& departure, const Increment<dim>& offset) const {
  return onward_of<dim>(measure_.strain(offset), departure);
}

template <int dim>
double ErrorEstimate<dim>::of_history(const Response<dim>& answer, const Departure<dim>& departure,
                                      const Excursion& point, const Excursion& cell) const {
  // Two that have not turned back differ in their places alone, which is no matter of history.
  const double missed = std::min(std::abs(point.depth - cell.depth), std::max(point.back, cell.back));
  if (missed == 0.0) return 0.0;
  const Vector apart = (elastic_ - answer.tangent) * measure_.unmeasured(missed * departure.direction);
  return kShareOfElastic * measure_.stress(apart);
}

template <int dim>
Departure<dim> ErrorEstimate<dim>::learn(const Response<dim>& start, const Response<dim>& end,
                                         const Increment<dim>& offset, Departure<dim>& at_start) const {
  const double size = measure_.size(offset);
  const Vector strain = measure_.strain(offset);
  const double missed = measure_.stress(end.stress - linearised_stress(start, offset));
  Departure<dim> seen;
  // The tangent may have changed more than the stress shows. In large deformation all is compared in the axes of the end.
  const bool turns = offset.configuration != Configuration::fixed;
  const Vector along = turns ? fem::rotated(strain, rotation_of(offset)) : strain;
  const Matrix before = with_tangent_turned(start, offset).tangent;
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

template struct Departure<2>;
template struct Departure<3>;
template class ErrorEstimate<2>;
template class ErrorEstimate<3>;

}  // namespace polargrain::coupler
