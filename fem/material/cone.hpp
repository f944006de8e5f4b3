// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "fem/material/piecewise_linear.hpp"

namespace polargrain::fem {

/// The cone F = q + M_phi p - k, Q = q + M_psi p at one gamma_p, with the slopes of its three parameters with
/// respect to gamma_p (docs/theory/plasticity.md, B.2).
template <class Scalar>
struct Cone {
  Scalar friction{};   ///< M_phi, dimensionless, >= 0
  Scalar dilatancy{};  ///< M_psi, dimensionless, positive when shearing expands
  Scalar cohesion{};   ///< k, Pa, >= 0
  double friction_slope = 0.0;
  double dilatancy_slope = 0.0;
  double cohesion_slope = 0.0;  ///< Pa

  /// F, Pa: negative inside the cone.
  [[nodiscard]] Scalar yield_function(const Scalar& q, const Scalar& mean) const {
    return q + friction * mean - cohesion;
  }
};

/// A cone that hardens or softens with the accumulated plastic shear. Call operator: the cone at gamma_p.
struct HardeningCone {
  PiecewiseLinear friction;   ///< M_phi(gamma_p)
  PiecewiseLinear dilatancy;  ///< M_psi(gamma_p)
  PiecewiseLinear cohesion;   ///< k(gamma_p), Pa

  template <class Scalar>
  Cone<Scalar> operator()(const Scalar& gamma_p) const {
    const auto phi = friction.at(gamma_p);
    const auto psi = dilatancy.at(gamma_p);
    const auto k = cohesion.at(gamma_p);
    return {phi.value, psi.value, k.value, phi.slope, psi.slope, k.slope};
  }
};

/// A cone held fixed over a step: mobilised friction and dilatancy given from outside, a point at a time
/// (docs/theory/plasticity.md, B.9). Call operator: the same cone for every gamma_p.
struct FrozenCone {
  double friction = 0.0;   ///< mu
  double dilatancy = 0.0;  ///< beta
  double cohesion = 0.0;   ///< k, Pa

  template <class Scalar>
  Cone<Scalar> operator()(const Scalar& /*gamma_p*/) const {
    return {Scalar(friction), Scalar(dilatancy), Scalar(cohesion)};
  }
};

}  // namespace polargrain::fem
