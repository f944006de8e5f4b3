// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/cone_matching.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/elementary_functions.hpp"
#include "common/error.hpp"

namespace polargrain::fem {

namespace {

constexpr double kRoot3 = std::numbers::sqrt3;
constexpr double kDegree = std::numbers::pi / 180.0;

void check(const MohrCoulomb& strength) {
  std::vector<Fault> faults;
  if (!(strength.friction_angle >= 0.0 && strength.friction_angle < 90.0)) {
    faults.push_back(
        {"", 0,
         fmt::format("the friction angle is {} degrees; it must be in [0, 90)", strength.friction_angle)});
  }
  if (!(strength.dilatancy_angle > -90.0 && strength.dilatancy_angle < 90.0)) {
    faults.push_back({"", 0,
                      fmt::format("the dilatancy angle is {} degrees; it must be in (-90, 90)",
                                  strength.dilatancy_angle)});
  }
  if (!(strength.cohesion >= 0.0) || !std::isfinite(strength.cohesion)) {
    faults.push_back(
        {"", 0, fmt::format("the cohesion is {} Pa; it must be zero or positive", strength.cohesion)});
  }
  if (!faults.empty()) {
    throw InputError(faults);
  }
}

/// M = 6 sin / (3 - side sin) with side = +1 in compression and -1 in extension.
FrozenCone triaxial_cone(const MohrCoulomb& strength, double side) {
  check(strength);
  const double sin_phi = sine(strength.friction_angle * kDegree);
  const double cos_phi = cosine(strength.friction_angle * kDegree);
  const double sin_psi = sine(strength.dilatancy_angle * kDegree);
  return {6.0 * sin_phi / (3.0 - side * sin_phi), 6.0 * sin_psi / (3.0 - side * sin_psi),
          6.0 * strength.cohesion * cos_phi / (3.0 - side * sin_phi)};
}

/// Dn of B.3: the denominator that friction and cohesion share.
double plane_strain_denominator(double sin_phi, double dilatancy) {
  return std::sqrt(1.0 - dilatancy * dilatancy / 9.0) + sin_phi * dilatancy * kRoot3 / 9.0;
}

}  // namespace

FrozenCone cone_from_plane_strain(const MohrCoulomb& strength) {
  check(strength);
  const double sin_phi = sine(strength.friction_angle * kDegree);
  const double cos_phi = cosine(strength.friction_angle * kDegree);
  const double sin_psi = sine(strength.dilatancy_angle * kDegree);
  const double dilatancy = kRoot3 * sin_psi / std::sqrt(1.0 + sin_psi * sin_psi / 3.0);
  const double denominator = plane_strain_denominator(sin_phi, dilatancy);
  return {kRoot3 * sin_phi / denominator, dilatancy, kRoot3 * strength.cohesion * cos_phi / denominator};
}

std::optional<MohrCoulomb> plane_strain_from_cone(const FrozenCone& cone) {
  const double ninth = cone.dilatancy * cone.dilatancy / 9.0;
  const double coupling = 1.0 - cone.friction * cone.dilatancy / 9.0;
  if (!(ninth < 1.0) || !(coupling > 0.0)) {
    return std::nullopt;
  }
  const double sin_phi = cone.friction * std::sqrt(1.0 - ninth) / (kRoot3 * coupling);
  const double sin_psi = cone.dilatancy / (kRoot3 * std::sqrt(1.0 - ninth));
  if (!(sin_phi < 1.0) || !(std::abs(sin_psi) < 1.0)) {
    return std::nullopt;
  }
  const double friction_angle = arc_sine(sin_phi);
  const double cohesion =
      cone.cohesion * plane_strain_denominator(sin_phi, cone.dilatancy) / (kRoot3 * cosine(friction_angle));
  return MohrCoulomb{friction_angle / kDegree, arc_sine(sin_psi) / kDegree, cohesion};
}

FrozenCone cone_from_triaxial_compression(const MohrCoulomb& strength) {
  return triaxial_cone(strength, 1.0);
}

FrozenCone cone_from_triaxial_extension(const MohrCoulomb& strength) {
  return triaxial_cone(strength, -1.0);
}

FrozenCone inner_cone(const MohrCoulomb& strength) {
  check(strength);
  const double sin_phi = sine(strength.friction_angle * kDegree);
  const double sin_psi = sine(strength.dilatancy_angle * kDegree);
  const double root = std::sqrt(1.0 + sin_phi * sin_phi / 3.0);
  return {kRoot3 * sin_phi / root, kRoot3 * sin_psi / std::sqrt(1.0 + sin_psi * sin_psi / 3.0),
          kRoot3 * strength.cohesion * cosine(strength.friction_angle * kDegree) / root};
}

FrozenCone matched_cone(const MohrCoulomb& strength, ConeMatch match) {
  switch (match) {
    case ConeMatch::triaxial_compression:
      return cone_from_triaxial_compression(strength);
    case ConeMatch::triaxial_extension:
      return cone_from_triaxial_extension(strength);
    case ConeMatch::inner:
      return inner_cone(strength);
    case ConeMatch::plane_strain:
      break;
  }
  return cone_from_plane_strain(strength);
}

std::optional<double> angle_in_extension(const FrozenCone& cone) {
  const double sin_phi = 3.0 * cone.friction / (6.0 - cone.friction);
  if (!(cone.friction < 1.5)) return std::nullopt;
  return arc_sine(sin_phi) / kDegree;
}

MohrCoulomb divided(const MohrCoulomb& strength, double factor) {
  const double phi = strength.friction_angle * kDegree;
  const double reduced = arc_sine(sine(phi) / std::hypot(sine(phi), factor * cosine(phi))) / kDegree;
  return {reduced, std::min(strength.dilatancy_angle, reduced), strength.cohesion / factor};
}

MohrCoulombHardening divided(const MohrCoulombHardening& strength, double factor) {
  std::vector<PiecewiseLinear::Knot> friction;
  std::vector<PiecewiseLinear::Knot> dilatancy;
  std::vector<PiecewiseLinear::Knot> cohesion;
  for (const double gamma_p :
       merged_knots({&strength.friction_angle, &strength.dilatancy_angle, &strength.cohesion})) {
    const MohrCoulomb whole{strength.friction_angle.at(gamma_p).value,
                            strength.dilatancy_angle.at(gamma_p).value, strength.cohesion.at(gamma_p).value};
    const MohrCoulomb here = divided(whole, factor);
    friction.push_back({gamma_p, here.friction_angle});
    dilatancy.push_back({gamma_p, here.dilatancy_angle});
    cohesion.push_back({gamma_p, here.cohesion});
  }
  return {PiecewiseLinear(friction), PiecewiseLinear(dilatancy), PiecewiseLinear(cohesion)};
}

HardeningCone hardening_cone_from_plane_strain(const MohrCoulombHardening& strength) {
  return hardening_cone(strength, ConeMatch::plane_strain);
}

HardeningCone hardening_cone(const MohrCoulombHardening& strength, ConeMatch match) {
  std::vector<PiecewiseLinear::Knot> friction;
  std::vector<PiecewiseLinear::Knot> dilatancy;
  std::vector<PiecewiseLinear::Knot> cohesion;
  for (const double gamma_p :
       merged_knots({&strength.friction_angle, &strength.dilatancy_angle, &strength.cohesion})) {
    const FrozenCone cone =
        matched_cone({strength.friction_angle.at(gamma_p).value, strength.dilatancy_angle.at(gamma_p).value,
                      strength.cohesion.at(gamma_p).value},
                     match);
    friction.push_back({gamma_p, cone.friction});
    dilatancy.push_back({gamma_p, cone.dilatancy});
    cohesion.push_back({gamma_p, cone.cohesion});
  }
  return {PiecewiseLinear(friction), PiecewiseLinear(dilatancy), PiecewiseLinear(cohesion)};
}

}  // namespace polargrain::fem
