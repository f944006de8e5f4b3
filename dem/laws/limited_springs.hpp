// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Springs that give way at a limit: along a line, one number; in a plane, a vector whose length is cut.
#include "dem/contact/standing_at_limit.hpp"
#include "dem/lanes/vectors.hpp"

namespace polargrain::dem {
namespace {

template <typename Choice, typename Number>
POLARGRAIN_INLINE Vector<Number> select(Choice chosen, const Vector<Number>& yes, const Vector<Number>& no) {
  return {select(chosen, yes.x, no.x), select(chosen, yes.y, no.y), select(chosen, yes.z, no.z)};
}
template <typename Number>
POLARGRAIN_INLINE Vector<Number> operator-(const Vector<Number>& a) {
  return {-a.x, -a.y, -a.z};
}

/// A safe divisor: `a` may be zero where the quotient is not used, or its numerator is zero too.
template <typename Number>
POLARGRAIN_INLINE Number not_zero(Number a) {
  return greater(a, all<Number>(1e-290));
}
template <typename Number>
POLARGRAIN_INLINE Number length(const Vector<Number>& a) {
  return root(dot(a, a));
}
/// Factor that cuts a length to a limit.
template <typename Number>
POLARGRAIN_INLINE Number cutting(Number length, Number limit) {
  return lesser(all<Number>(1.0), limit / not_zero(length));
}

/// Cuts a force down to a limit, keeping its direction. @return whether it was beyond.
template <typename Number>
POLARGRAIN_INLINE auto cut(Number& force, Number limit) {
  const auto beyond = magnitude(force) > limit;
  force = select(beyond, with_sign_of(limit, force), force);
  return beyond;
}
template <typename Number>
POLARGRAIN_INLINE auto cut(Vector<Number>& force, Number limit) {
  const Number size = length(force);
  force = cutting(size, limit) * force;
  return size > limit;
}

/// Whether a force that has been cut stands at its limit; one without a limit, which is zero, does.
template <typename Number>
POLARGRAIN_INLINE auto stands_at(Number force, Number limit) {
  return magnitude(force) >= kStandingAtLimit * limit;
}
template <typename Number>
POLARGRAIN_INLINE auto stands_at(const Vector<Number>& force, Number limit) {
  const Number least = kStandingAtLimit * limit;
  return dot(force, force) >= least * least;
}

/// The spring that has a force: its own where the force is cut, else `spring`. Quotients along a line are rarely asked for.
template <typename Choice, typename Number>
POLARGRAIN_INLINE Number given_way(Choice is_cut, Number force, Number stiffness, Number spring) {
  if (!any(is_cut)) return spring;
  return select(is_cut & (stiffness > 0.0), force / stiffness, spring);
}
template <typename Choice, typename Number>
POLARGRAIN_INLINE Vector<Number> given_way(Choice is_cut, const Vector<Number>& force, Number stiffness,
                                           const Vector<Number>& spring) {
  return select(is_cut, (1.0 / not_zero(stiffness)) * force, spring);
}

/// The force of a spring, which gives way where that is beyond its limit. @return whether it was
/// (A structure of springs would be copied through memory.)
template <typename Number>
POLARGRAIN_INLINE auto limited_force(Number& spring, Number stiffness, Number limit, Number& force) {
  force = stiffness * spring;
  const auto beyond = cut(force, limit);
  spring = given_way(beyond, force, stiffness, spring);
  return beyond;
}
template <typename Number>
POLARGRAIN_INLINE auto limited_force(Vector<Number>& spring, Number stiffness, Number limit,
                                     Vector<Number>& force) {
  const Number size = stiffness * length(spring);
  spring = cutting(size, limit) * spring;
  force = stiffness * spring;
  return size > limit;
}

}  // namespace
}  // namespace polargrain::dem
