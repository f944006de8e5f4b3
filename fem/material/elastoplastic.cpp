// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/elastoplastic.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/error.hpp"

namespace polargrain::fem {

namespace {

std::string explain(ReturnFault fault, const ConeReturn<double>& end) {
  switch (fault) {
    case ReturnFault::not_finite:
      return "the trial stress is not a finite number; the increment of strain is broken or far too large";
    case ReturnFault::no_strength:
      return fmt::format(
          "the cone has no strength left in this step (M_phi = {:.6g}, k = {:.6g} Pa at its start)",
          end.cone.friction, end.cone.cohesion);
    case ReturnFault::supercritical:
      return "softening is too steep at this pressure: the plastic multiplier is not unique "
             "(3G + K M_phi M_psi - M_phi' p + k' must be positive); soften over a larger range of gamma_p";
    case ReturnFault::not_converged:
      return fmt::format("the yield equation was not solved in {} evaluations", end.evaluations);
    case ReturnFault::none:
      break;
  }
  return {};
}

/// diag(1, 1, 1, 1, 1, lc, lc): scaled strain = scale * strain, stress = scale * scaled stress.
Vector7 component_scale(double length) {
  Vector7 scale = Vector7::Ones();
  scale.tail<2>().setConstant(length);
  return scale;
}

template <class ConeAt>
Response integrate(const ElastoplasticFrame& frame, const ConeAt& cone, const ElastoplasticState& start,
                   const Vector7& strain_increment, ElastoplasticState& trial) {
  const Vector7 scale = component_scale(frame.length);
  const ScaledVector<double> strain = strain_increment.cwiseProduct(scale);
  const ScaledVector<double> trial_stress = start.scaled_stress + elastic_stress(frame.moduli, strain);
  const ConeReturn<double> end = return_to_cone(trial_stress, start.gamma_p, frame.moduli, cone);

  Response response;
  if (end.fault != ReturnFault::none) {
    trial = start;
    response.stress = frame.unscaled_stress(start.scaled_stress);
    response.quality = Quality::failed;
    response.message = explain(end.fault, end);
    response.step_factor = 0.25;
    return response;
  }
  trial = {end.stress, start.gamma_p + end.gamma_increment, end.regime};
  response.stress = frame.unscaled_stress(end.stress);
  ScaledMatrix<double> tangent = consistent_tangent(trial_stress, end, frame.moduli);
  if (end.regime == Regime::apex) {
    tangent += frame.apex_stiffness_share * elastic_stiffness(frame.moduli);
  }
  response.tangent = scale.asDiagonal() * tangent * scale.asDiagonal();
  return response;
}

}  // namespace

Vector7 ElastoplasticFrame::unscaled_stress(const ScaledVector<double>& scaled) const {
  return scaled.cwiseProduct(component_scale(length));
}

Response integrate_elastoplastic(const ElastoplasticFrame& frame, const HardeningCone& cone,
                                 const ElastoplasticState& start, const Increment& increment,
                                 ElastoplasticState& trial) {
  return integrate(frame, cone, start, increment.strain(), trial);
}

Response integrate_elastoplastic(const ElastoplasticFrame& frame, const HardeningCone& cone,
                                 const ElastoplasticState& start, const Vector7& strain,
                                 ElastoplasticState& trial) {
  return integrate(frame, cone, start, strain, trial);
}

Response integrate_elastoplastic(const ElastoplasticFrame& frame, const FrozenCone& cone,
                                 const ElastoplasticState& start, const Increment& increment,
                                 ElastoplasticState& trial) {
  return integrate(frame, cone, start, increment.strain(), trial);
}

ElastoplasticLaw::ElastoplasticLaw(const ElastoplasticParameters& parameters)
    : frame_{SubspaceModuli(parameters.elastic, parameters.weights), parameters.elastic.internal_length,
             parameters.apex_stiffness_share},
      cone_(parameters.cone) {
  if (const std::vector<std::string> found = faults(parameters); !found.empty()) {
    throw RunError(fmt::format("elastoplastic material: {}", fmt::join(found, "; ")));
  }
  initial_state_ = initial_state(parameters.elastic.initial_stress);
}

ElastoplasticState ElastoplasticLaw::initial_state(const Vector7& stress) const {
  State state;
  state.scaled_stress = stress;
  if (frame_.length > 0.0) {
    state.scaled_stress.tail<2>() /= frame_.length;
  }
  return state;
}

std::vector<double> ElastoplasticLaw::packed(const State& state) {
  std::vector<double> values(state.scaled_stress.begin(), state.scaled_stress.end());
  values.push_back(state.gamma_p);
  values.push_back(static_cast<double>(state.regime));
  return values;
}

ElastoplasticState ElastoplasticLaw::unpacked(std::span<const double> values) {
  State state;
  const auto stress = static_cast<std::size_t>(state.scaled_stress.size());
  std::copy_n(values.begin(), stress, state.scaled_stress.begin());
  state.gamma_p = values[stress];
  for (const Regime regime : {Regime::elastic, Regime::smooth, Regime::apex}) {
    if (values[stress + 1] == static_cast<double>(regime)) state.regime = regime;
  }
  return state;
}

void ElastoplasticLaw::fields(const State& state, std::span<double> values) const {
  values[0] = state.gamma_p;
  values[1] = static_cast<double>(state.regime);
}

}  // namespace polargrain::fem
