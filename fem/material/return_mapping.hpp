// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "fem/material/cone.hpp"
#include "fem/material/stress_subspaces.hpp"

namespace polargrain::fem {

/// Where a step ended.
enum class Regime : std::uint8_t {
  elastic,  ///< inside the cone
  smooth,   ///< on the cone
  apex      ///< at its tip
};

/// Why a return mapping has no answer.
enum class ReturnFault : std::uint8_t {
  none,
  not_finite,     ///< the trial stress is not a finite number
  no_strength,    ///< friction and cohesion are both zero (or negative): the cone has no inside
  supercritical,  ///< softening is too steep: the plastic multiplier is not unique
  not_converged   ///< the scalar equation was not solved
};

/// Answer of return_to_cone. All stresses scaled (stress_subspaces.hpp), Pa.
template <class Scalar, int dim = 2>
struct ConeReturn {
  Regime regime = Regime::elastic;
  ReturnFault fault = ReturnFault::none;
  ScaledVector<Scalar, dim> stress = ScaledVector<Scalar, dim>::Zero();
  Scalar gamma_increment{};  ///< d lambda = d gamma_p
  Scalar zeta{};             ///< 3 d lambda / (2 q), 1/Pa; smooth returns only
  Cone<Scalar> cone;         ///< at the end of the step
  double residual = 0.0;     ///< |F| over q + M_phi |p| + k of the trial state; smooth returns only
  int evaluations = 0;       ///< of the scalar equation
};

namespace detail {

/// The scalar yield equation of B.4, F(retained) = 0, and everything that is known on the way.
template <class Scalar>
struct YieldPoint {
  Scalar value;            ///< F, Pa
  Scalar slope;            ///< dF / d retained, Pa
  Scalar zeta;             ///< 1/Pa
  Scalar gamma_increment;  ///< d lambda
  Scalar mean;             ///< p, Pa
  Cone<Scalar> cone;
};

/// Trial state reduced to the numbers that the scalar equation needs.
template <class Scalar, class ConeAt>
struct YieldEquation {
  const SubspaceModuli& moduli;
  const ConeAt& cone_at;
  Scalar gamma_p;                    ///< at the start of the step
  Scalar mean;                       ///< trial p
  std::array<Scalar, 3> squared{};   ///< n_k of the trial stress, |s_k|^2 (square_of_part)
  std::array<double, 3> relative{};  ///< r_k = c_k / (2G)

  template <int dim>
  YieldEquation(const SubspaceModuli& m, const ConeAt& c, const Scalar& gamma,
                const Split<Scalar, dim>& trial)
      : moduli(m), cone_at(c), gamma_p(gamma), mean(trial.mean) {
    for (std::size_t k = 0; k < 3; ++k) {
      squared[k] = square_of_part(trial, k, m.couples);
      relative[k] = m.return_stiffness(k) / (2.0 * m.shear());
    }
  }

  /// B.4. The unknown is the share of the symmetric deviator that is retained, in (0, 1]: in it every term is
  /// regular, 1 is the trial state and 0 the apex side.
  [[nodiscard]] YieldPoint<Scalar> at(const Scalar& retained) const {
    using std::sqrt;
    Scalar sum(0.0);
    Scalar sum_slope(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      const Scalar below = retained + relative[k] * (1.0 - retained);
      const Scalar share = retained / below;  // u_k = 1 / (1 + zeta c_k)
      sum += moduli.weight[k] * squared[k] * share * share;
      sum_slope += moduli.weight[k] * squared[k] * share * relative[k] / (below * below);
    }
    const Scalar q = sqrt(1.5 * sum);
    const Scalar q_slope = 1.5 / q * sum_slope;
    const double twice_shear = 2.0 * moduli.shear();
    const Scalar zeta = (1.0 / retained - 1.0) / twice_shear;
    const Scalar zeta_slope = -1.0 / (twice_shear * retained * retained);

    YieldPoint<Scalar> point;
    point.zeta = zeta;
    point.gamma_increment = 2.0 / 3.0 * zeta * q;
    point.cone = cone_at(Scalar(gamma_p + point.gamma_increment));
    const Cone<Scalar>& cone = point.cone;
    point.mean = mean - moduli.bulk * cone.dilatancy * point.gamma_increment;
    point.value = cone.yield_function(q, point.mean);
    const Scalar gamma_slope = 2.0 / 3.0 * (q * zeta_slope + zeta * q_slope);
    point.slope = q_slope + hardening_modulus(point) * gamma_slope;
    return point;
  }

  /// H = M_phi' p - k' - K M_phi (M_psi + d lambda M_psi'), Pa: how F follows gamma_p at fixed q (B.6).
  [[nodiscard]] Scalar hardening_modulus(const YieldPoint<Scalar>& point) const {
    const Cone<Scalar>& cone = point.cone;
    return cone.friction_slope * point.mean - cone.cohesion_slope -
           moduli.bulk * cone.friction * (cone.dilatancy + point.gamma_increment * cone.dilatancy_slope);
  }
};

/// d lambda* of B.5: the plastic multiplier that brings the deviator to zero.
template <class Scalar>
Scalar apex_gamma_increment(const SubspaceModuli& moduli, const std::array<Scalar, 3>& squared) {
  using std::sqrt;
  Scalar sum(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const double c = moduli.return_stiffness(k);
    if (c > 0.0) {
      sum += moduli.weight[k] / (c * c) * squared[k];
    }
  }
  // The root of an exact zero has no derivative, and neither has the root of a purely volumetric trial.
  return real_part(sum) > 0.0 ? 2.0 / 3.0 * sqrt(1.5 * sum) : Scalar(0.0);
}

/// Divides the bracket (low, high) of the retained share o evenly in the logarithm of zeta ~ (1 - o) / o.
/// When Gc and G differ by orders of magnitude the root hides close to 0 or 1, where halving o would creep.
inline double bracket_middle(double low, double high) {
  constexpr double kStride = 100.0;  // while one end still is 0 or 1
  const auto zeta_at = [](double retained) { return (1.0 - retained) / retained; };
  if (low == 0.0 && high == 1.0) {
    return 0.5;
  }
  const double zeta = low == 0.0    ? zeta_at(high) * kStride
                      : high == 1.0 ? zeta_at(low) / kStride
                                    : std::sqrt(zeta_at(low) * zeta_at(high));
  return 1.0 / (1.0 + zeta);
}

/// Newton's method in the retained share, kept inside a bracket that starts as (0, 1].
/// F > 0 at 1 and F < 0 towards 0 must hold. `scale` (Pa) is the fixed measure of the residual.
template <class Scalar, class ConeAt>
bool solve_yield_equation(const YieldEquation<Scalar, ConeAt>& equation, double guess, double scale,
                          YieldPoint<Scalar>& point, int& evaluations) {
  constexpr double kTolerance = 1e-13;   // a few hundred roundings of the trial stress
  constexpr double kStagnation = 1e-10;  // accepted once the bracket cannot be divided any more
  constexpr int kMostEvaluations = 200;
  // Imaginary parts carry derivatives; they converge one Newton step after the real part at the latest.
  constexpr int kPolish = std::is_same_v<Scalar, double> ? 0 : 3;
  double low = 0.0;
  double high = 1.0;
  Scalar retained(guess);
  point = equation.at(retained);
  for (evaluations = 1; evaluations < kMostEvaluations; ++evaluations) {
    const double residual = real_part(point.value);
    if (std::abs(residual) <= kTolerance * scale) {
      for (int i = 0; i < kPolish; ++i) {
        retained -= point.value / point.slope;
        point = equation.at(retained);
      }
      return true;
    }
    (residual < 0.0 ? low : high) = real_part(retained);
    Scalar next = retained - point.value / point.slope;
    const bool inside = real_part(next) > low && real_part(next) < high;
    // Newton can creep towards the root from one side across the kinks of tabulated strengths.
    const bool slow = evaluations > 12 && evaluations % 2 == 0;
    if (!inside || slow) {
      next = Scalar(bracket_middle(low, high));
      if (real_part(next) <= low || real_part(next) >= high) {
        return std::abs(residual) <= kStagnation * scale;
      }
    }
    retained = next;
    point = equation.at(retained);
  }
  return false;
}

/// Two-mechanism return to the tip, B.5: explicit, for any dilatancy. `cone` is the one at the end of the
/// step.
template <class Scalar, int dim>
void return_to_apex(const Split<Scalar, dim>& trial, const SubspaceModuli& moduli,
                    const Scalar& gamma_increment, const Cone<Scalar>& cone,
                    ConeReturn<Scalar, dim>& result) {
  result.regime = Regime::apex;
  result.gamma_increment = gamma_increment;
  result.cone = cone;
  result.stress = (cone.cohesion / cone.friction) * volumetric_vector<Scalar, dim>();
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(moduli.return_stiffness(k) > 0.0)) {
      result.stress += trial.part[k];
    }
  }
}

/// Return to the side of the cone, B.4. `trial_q` and `trial_yield` (Pa) belong to the trial state and
/// result.cone to the start of the step.
template <class Scalar, int dim, class ConeAt>
void return_to_side(const Split<Scalar, dim>& trial, const YieldEquation<Scalar, ConeAt>& equation,
                    double trial_q, double trial_yield, double scale, ConeReturn<Scalar, dim>& result) {
  const SubspaceModuli& moduli = equation.moduli;
  result.regime = Regime::smooth;
  // Exact for perfect plasticity with the default invariant weights.
  const double shear_stiffness = 3.0 * moduli.shear();
  const double multiplier = trial_yield / (shear_stiffness + moduli.bulk * real_part(result.cone.friction) *
                                                                 real_part(result.cone.dilatancy));
  const double guess = std::clamp(1.0 - shear_stiffness * multiplier / trial_q, 1e-3, 1.0);
  // The multiplier is unique where F falls all along the way from the trial state. Looked at at both ends,
  // which finds every steep piece that the step starts or ends on; faults() looks at all pieces beforehand.
  if (!(real_part(equation.at(Scalar(1.0)).slope) > 0.0)) {
    result.fault = ReturnFault::supercritical;
    return;
  }
  YieldPoint<Scalar> point;
  if (!solve_yield_equation(equation, guess, scale, point, result.evaluations)) {
    result.fault = ReturnFault::not_converged;
    return;
  }
  if (!(real_part(point.slope) > 0.0)) {
    result.fault = ReturnFault::supercritical;
    return;
  }
  result.gamma_increment = point.gamma_increment;
  result.zeta = point.zeta;
  result.cone = point.cone;
  result.residual = std::abs(real_part(point.value)) / scale;
  result.stress = point.mean * volumetric_vector<Scalar, dim>();
  for (std::size_t k = 0; k < 3; ++k) {
    result.stress += trial.part[k] / (1.0 + point.zeta * moduli.return_stiffness(k));
  }
}

}  // namespace detail

/// Backward-Euler return of a trial stress to a cone (docs/theory/plasticity.md, B.4, B.5).
///
/// @param trial   scaled trial stress, Pa
/// @param gamma_p accumulated plastic shear at the start of the step
/// @param cone_at callable, gamma_p -> Cone: HardeningCone, FrozenCone or any other
/// Never throws: a stress that cannot be returned comes back with a fault, and must not be used.
template <class Scalar, int size, class ConeAt>
ConeReturn<Scalar, dimension_of_components<size>> return_to_cone(const Eigen::Matrix<Scalar, size, 1>& trial,
                                                                 const Scalar& gamma_p,
                                                                 const SubspaceModuli& moduli,
                                                                 const ConeAt& cone_at) {
  constexpr int dim = dimension_of_components<size>;
  // An elastic step must also be found elastic when it starts on the cone, where the last return left it
  // within rounding of F = 0.
  constexpr double kElasticTolerance = 1e-12;
  ConeReturn<Scalar, dim> result;
  result.stress = trial;
  result.gamma_increment = Scalar(0.0);
  result.cone = cone_at(gamma_p);
  const Split<Scalar, dim> split(trial);
  const Scalar q = deviatoric_stress(split, moduli);
  const Scalar yield = result.cone.yield_function(q, split.mean);
  const double scale = std::abs(real_part(q)) + std::abs(real_part(result.cone.friction * split.mean)) +
                       std::abs(real_part(result.cone.cohesion));
  if (!std::isfinite(real_part(yield))) {
    result.fault = ReturnFault::not_finite;
    return result;
  }
  if (real_part(yield) <= kElasticTolerance * scale) {
    return result;
  }

  const detail::YieldEquation<Scalar, ConeAt> equation(moduli, cone_at, gamma_p, split);
  const Scalar apex_increment = detail::apex_gamma_increment(moduli, equation.squared);
  const Cone<Scalar> apex_cone = cone_at(Scalar(gamma_p + apex_increment));
  const double apex_friction = real_part(apex_cone.friction);
  if (apex_friction < 0.0 || real_part(apex_cone.cohesion) < 0.0 ||
      (apex_friction == 0.0 && real_part(apex_cone.cohesion) == 0.0)) {
    result.fault = ReturnFault::no_strength;
    return result;
  }
  const Scalar apex_mean = split.mean - moduli.bulk * apex_cone.dilatancy * apex_increment;
  if (apex_friction > 0.0 && real_part(apex_cone.yield_function(Scalar(0.0), apex_mean)) >= 0.0) {
    detail::return_to_apex(split, moduli, apex_increment, apex_cone, result);
  } else {
    detail::return_to_side(split, equation, real_part(q), real_part(yield), scale, result);
  }
  return result;
}

}  // namespace polargrain::fem
