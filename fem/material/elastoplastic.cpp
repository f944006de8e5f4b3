// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/elastoplastic.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/error.hpp"

namespace polargrain::fem {

namespace {

template <int dim>
std::string explain(ReturnFault fault, const ConeReturn<double, dim>& end) {
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

/// diag(1 for stresses, lc for couple stresses): scaled strain = scale * strain, stress = scale * scaled stress.
template <int dim>
typename Cosserat<dim>::Vector component_scale(double length) {
  typename Cosserat<dim>::Vector scale = Cosserat<dim>::Vector::Ones();
  scale.template tail<Cosserat<dim>::couples>().setConstant(length);
  return scale;
}

template <int dim, class ConeAt>
Response<dim> integrate(const ElastoplasticFrame<dim>& frame, const ConeAt& cone,
                        const ElastoplasticState<dim>& start,
                        const typename Cosserat<dim>::Vector& strain_increment,
                        ElastoplasticState<dim>& trial) {
  const typename Cosserat<dim>::Vector scale = component_scale<dim>(frame.length);
  const ScaledVector<double, dim> strain = strain_increment.cwiseProduct(scale);
  const ScaledVector<double, dim> trial_stress = start.scaled_stress + elastic_stress(frame.moduli, strain);
  const ConeReturn<double, dim> end = return_to_cone(trial_stress, start.gamma_p, frame.moduli, cone);

  Response<dim> response;
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
  ScaledMatrix<double, dim> tangent = consistent_tangent(trial_stress, end, frame.moduli);
  if (end.regime == Regime::apex) {
    tangent += frame.apex_stiffness_share * elastic_stiffness<dim>(frame.moduli);
  }
  response.tangent = scale.asDiagonal() * tangent * scale.asDiagonal();
  return response;
}

}  // namespace

template <int dim>
typename Cosserat<dim>::Vector ElastoplasticFrame<dim>::unscaled_stress(
    const ScaledVector<double, dim>& scaled) const {
  return scaled.cwiseProduct(component_scale<dim>(length));
}

template <int dim>
Response<dim> integrate_elastoplastic(const ElastoplasticFrame<dim>& frame, const HardeningCone& cone,
                                      const ElastoplasticState<dim>& start, const Increment<dim>& increment,
                                      ElastoplasticState<dim>& trial) {
  return integrate(frame, cone, start, increment.strain(), trial);
}

template <int dim>
Response<dim> integrate_elastoplastic(const ElastoplasticFrame<dim>& frame, const HardeningCone& cone,
                                      const ElastoplasticState<dim>& start,
                                      const typename Cosserat<dim>::Vector& strain,
                                      ElastoplasticState<dim>& trial) {
  return integrate(frame, cone, start, strain, trial);
}

template <int dim>
Response<dim> integrate_elastoplastic(const ElastoplasticFrame<dim>& frame, const FrozenCone& cone,
                                      const ElastoplasticState<dim>& start, const Increment<dim>& increment,
                                      ElastoplasticState<dim>& trial) {
  return integrate(frame, cone, start, increment.strain(), trial);
}

template <int dim>
ElastoplasticLaw<dim>::ElastoplasticLaw(const ElastoplasticParameters<dim>& parameters)
    : frame_{SubspaceModuli(parameters.elastic, parameters.weights), parameters.elastic.internal_length,
             parameters.apex_stiffness_share},
      cone_(parameters.cone) {
  if (const std::vector<std::string> found = faults(parameters); !found.empty()) {
    throw RunError(fmt::format("elastoplastic material: {}", fmt::join(found, "; ")));
  }
  initial_state_ = initial_state(parameters.elastic.initial_stress);
}

template <int dim>
ElastoplasticState<dim> ElastoplasticLaw<dim>::initial_state(
    const typename Cosserat<dim>::Vector& stress) const {
  State state;
  state.scaled_stress = stress;
  if (frame_.length > 0.0) {
    state.scaled_stress.template tail<Cosserat<dim>::couples>() /= frame_.length;
  }
  return state;
}

template <int dim>
std::vector<double> ElastoplasticLaw<dim>::packed(const State& state) {
  std::vector<double> values(state.scaled_stress.begin(), state.scaled_stress.end());
  values.push_back(state.gamma_p);
  values.push_back(static_cast<double>(state.regime));
  return values;
}

template <int dim>
ElastoplasticState<dim> ElastoplasticLaw<dim>::unpacked(std::span<const double> values) {
  State state;
  const auto stress = static_cast<std::size_t>(state.scaled_stress.size());
  std::copy_n(values.begin(), stress, state.scaled_stress.begin());
  state.gamma_p = values[stress];
  for (const Regime regime : {Regime::elastic, Regime::smooth, Regime::apex}) {
    if (values[stress + 1] == static_cast<double>(regime)) state.regime = regime;
  }
  return state;
}

template <int dim>
void ElastoplasticLaw<dim>::fields(const State& state, std::span<double> values) const {
  values[0] = state.gamma_p;
  values[1] = static_cast<double>(state.regime);
}

template Response<2> integrate_elastoplastic<2>(const ElastoplasticFrame<2>& frame, const HardeningCone& cone,
                                                const ElastoplasticState<2>& start,
                                                const Increment<2>& increment, ElastoplasticState<2>& trial);
template Response<3> integrate_elastoplastic<3>(const ElastoplasticFrame<3>& frame, const HardeningCone& cone,
                                                const ElastoplasticState<3>& start,
                                                const Increment<3>& increment, ElastoplasticState<3>& trial);
template Response<2> integrate_elastoplastic<2>(const ElastoplasticFrame<2>& frame, const HardeningCone& cone,
                                                const ElastoplasticState<2>& start,
                                                const Cosserat<2>::Vector& strain,
                                                ElastoplasticState<2>& trial);
template Response<3> integrate_elastoplastic<3>(const ElastoplasticFrame<3>& frame, const HardeningCone& cone,
                                                const ElastoplasticState<3>& start,
                                                const Cosserat<3>::Vector& strain,
                                                ElastoplasticState<3>& trial);
template Response<2> integrate_elastoplastic<2>(const ElastoplasticFrame<2>& frame, const FrozenCone& cone,
                                                const ElastoplasticState<2>& start,
                                                const Increment<2>& increment, ElastoplasticState<2>& trial);
template Response<3> integrate_elastoplastic<3>(const ElastoplasticFrame<3>& frame, const FrozenCone& cone,
                                                const ElastoplasticState<3>& start,
                                                const Increment<3>& increment, ElastoplasticState<3>& trial);
template class ElastoplasticFrame<2>;
template class ElastoplasticFrame<3>;
template class ElastoplasticLaw<2>;
template class ElastoplasticLaw<3>;

}  // namespace polargrain::fem
