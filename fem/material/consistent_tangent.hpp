// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cmath>

#include "fem/material/return_mapping.hpp"

namespace polargrain::fem {

namespace detail {

/// Tangent on the side of the cone, B.6: a few products of vectors, no matrix is inverted.
template <int dim>
ScaledMatrix<double, dim> side_tangent(const ConeReturn<double, dim>& end, const SubspaceModuli& moduli) {
  const Split<double, dim> stress(end.stress);
  const Cone<double>& cone = end.cone;
  const double q = deviatoric_stress(stress, moduli);
  const double zeta = end.zeta;
  const ScaledVector<double, dim> one = volumetric_vector<double, dim>();

  ScaledVector<double, dim> q_direction = ScaledVector<double, dim>::Zero();       // a: dq at fixed zeta
  ScaledVector<double, dim> return_direction = ScaledVector<double, dim>::Zero();  // sum_k (c_k / w_k) s_k
  std::array<double, 3> retained_stiffness{};                                      // d_k / w_k
  double q_softening = 0.0;                                                        // A: -dq / d zeta
  for (std::size_t k = 0; k < 3; ++k) {
    const double c = moduli.return_stiffness(k);
    const double w = 1.0 + zeta * c;
    retained_stiffness[k] = moduli.stiffness[k] / w;
    q_direction += 1.5 / q * moduli.weight[k] * retained_stiffness[k] * stress.part[k];
    q_softening += 1.5 / q * moduli.weight[k] * c / w * square_of_part(stress, k, moduli.couples);
    return_direction += c / w * stress.part[k];
  }
  const double dilatancy = cone.dilatancy + end.gamma_increment * cone.dilatancy_slope;
  double mean = stress.mean;
  if constexpr (dim == 2)
    mean = end.stress.template head<3>().sum() / 3.0;  // the order of the sum decides its last bit
  const double hardening =
      cone.friction_slope * mean - cone.cohesion_slope - moduli.bulk * cone.friction * dilatancy;  // H
  const double multiplier_growth = q - zeta * q_softening;  // (3/2) d lambda / d zeta
  const ScaledVector<double, dim> zeta_gradient =
      ((1.0 + 2.0 / 3.0 * hardening * zeta) * q_direction + cone.friction * moduli.bulk * one) /
      (q_softening - 2.0 / 3.0 * hardening * multiplier_growth);
  const ScaledVector<double, dim> gamma_gradient =
      2.0 / 3.0 * (zeta * q_direction + multiplier_growth * zeta_gradient);

  ScaledMatrix<double, dim> tangent = subspace_matrix<double, dim>(retained_stiffness, moduli.couples);
  add_volumetric(tangent, moduli.bulk);
  tangent.noalias() -= (moduli.bulk * dilatancy) * one * gamma_gradient.transpose();
  tangent.noalias() -= return_direction * zeta_gradient.transpose();
  return tangent;
}

/// Tangent at the tip, B.5: of rank one, plus the subspaces that the return leaves alone.
template <int dim>
ScaledMatrix<double, dim> apex_tangent(const Split<double, dim>& trial, const ConeReturn<double, dim>& end,
                                       const SubspaceModuli& moduli) {
  ScaledVector<double, dim> gradient = ScaledVector<double, dim>::Zero();
  std::array<double, 3> untouched{};
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double c = moduli.return_stiffness(k);
    if (c > 0.0) {
      const double factor = moduli.weight[k] / (c * c);
      gradient += factor * moduli.stiffness[k] * trial.part[k];
      sum += factor * square_of_part(trial, k, moduli.couples);
    } else {
      untouched[k] = moduli.stiffness[k];
    }
  }
  if (sum > 0.0) {  // a purely volumetric trial sits on the kink of d lambda*: the zero subgradient
    gradient /= std::sqrt(1.5 * sum);
  }
  const Cone<double>& cone = end.cone;
  const double apex_slope = (cone.cohesion_slope * cone.friction - cone.cohesion * cone.friction_slope) /
                            (cone.friction * cone.friction);  // d p_a / d gamma_p
  ScaledMatrix<double, dim> tangent = subspace_matrix<double, dim>(untouched, moduli.couples);
  tangent.noalias() += apex_slope * volumetric_vector<double, dim>() * gradient.transpose();
  return tangent;
}

}  // namespace detail

/// d stress / d strain of the whole step in scaled components, Pa: the exact linearisation of return_to_cone
/// (docs/theory/plasticity.md, B.5, B.6). Not symmetric where dilatancy and friction differ.
/// @param trial the trial stress that `end` was returned from; `end` must carry no fault.
template <int size>
Eigen::Matrix<double, size, size> consistent_tangent(
    const Eigen::Matrix<double, size, 1>& trial, const ConeReturn<double, dimension_of_components<size>>& end,
    const SubspaceModuli& moduli) {
  constexpr int dim = dimension_of_components<size>;
  switch (end.regime) {
    case Regime::smooth:
      return detail::side_tangent(end, moduli);
    case Regime::apex:
      return detail::apex_tangent(Split<double, dim>(trial), end, moduli);
    case Regime::elastic:
      break;
  }
  return elastic_stiffness<dim>(moduli);
}

}  // namespace polargrain::fem
