// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "fem/material/consistent_tangent.hpp"
#include "fem/material/elastic.hpp"

namespace polargrain::fem {

/// Generalised pressure-dependent elastoplastic Cosserat material (docs/theory/plasticity.md, B.1 to B.6).
template <int dim>
struct ElastoplasticParameters {
  /// Elasticity and the initial stress. With cosserat_shear_modulus = 0 the initial stress must have no skew
  /// shear, with internal_length = 0 no couple stress: nothing could carry their change.
  ElasticParameters<dim> elastic;
  InvariantWeights weights;
  /// From hardening_cone_from_plane_strain (cone_matching.hpp), or given directly.
  HardeningCone cone;
  /// Share of the elastic stiffness added to the tangent (not to the stress) at the apex, whose own tangent
  /// is of rank one and would make the global matrix singular. In [0, 1).
  double apex_stiffness_share = 1e-3;
};

/// The faults of the parameters, one message each; empty when the law is usable. Names the bound and
/// the value; tests the softening bound (B.2) on every piece of the hardening functions at the initial mean
/// stress. Under a larger pressure it may still be passed: then integrate fails and says so.
template <int dim>
std::vector<std::string> faults(const ElastoplasticParameters<dim>& parameters);

/// The least value of 3G + K M_phi (M_psi + d lambda M_psi') - M_phi' p + k' over all pieces of the hardening
/// functions at mean stress `mean` (Pa, tension positive) for small steps, Pa; must be positive (B.2).
double softening_reserve(const HardeningCone& cone, const SubspaceModuli& moduli, double mean);

/// The material state of a point: everything that the next step starts from.
template <int dim>
struct ElastoplasticState {
  /// Couple stresses over lc, all Pa.
  ScaledVector<double, dim> scaled_stress = ScaledVector<double, dim>::Zero();
  double gamma_p = 0.0;             ///< accumulated plastic shear = sum of d lambda
  Regime regime = Regime::elastic;  ///< how the last step ended
};

/// The frame that turns unscaled increments into scaled ones and holds the elastic constants of the return mapping.
template <int dim>
struct ElastoplasticFrame {
  SubspaceModuli moduli;
  double length = 0.0;  ///< lc, m
  double apex_stiffness_share = 0.0;

  /// Stress with couple stresses in N/m of a scaled stress.
  [[nodiscard]] typename Cosserat<dim>::Vector unscaled_stress(const ScaledVector<double, dim>& scaled) const;
};

/// One step of one point with any cone. Never throws; a step without an answer is Quality::failed and leaves
/// `trial` equal to `start`. Response::tangent is consistent with the step (plus the apex share).
template <int dim>
Response<dim> integrate_elastoplastic(const ElastoplasticFrame<dim>& frame, const HardeningCone& cone,
                                      const ElastoplasticState<dim>& start, const Increment<dim>& increment,
                                      ElastoplasticState<dim>& trial);
/// The same with mobilised friction and dilatancy given from outside for this step (B.9).
template <int dim>
Response<dim> integrate_elastoplastic(const ElastoplasticFrame<dim>& frame, const FrozenCone& cone,
                                      const ElastoplasticState<dim>& start, const Increment<dim>& increment,
                                      ElastoplasticState<dim>& trial);

/// The same along a strain; in the plane eps_33 need not be zero.
template <int dim>
Response<dim> integrate_elastoplastic(const ElastoplasticFrame<dim>& frame, const HardeningCone& cone,
                                      const ElastoplasticState<dim>& start,
                                      const typename Cosserat<dim>::Vector& strain,
                                      ElastoplasticState<dim>& trial);

/// The elastoplastic material as a local law (local_material.hpp).
template <int dim>
class ElastoplasticLaw {
 public:
  static constexpr int dimension = dim;
  using State = ElastoplasticState<dim>;

  /// @throws RunError with all faults of the parameters.
  explicit ElastoplasticLaw(const ElastoplasticParameters<dim>& parameters);

  [[nodiscard]] State initial_state() const { return initial_state_; }
  /// @param stress with couple stresses in N/m. A stress outside the cone is returned to it in the first
  /// step.
  [[nodiscard]] State initial_state(const typename Cosserat<dim>::Vector& stress) const;
  [[nodiscard]] static State rotated(State state, const Turn<dim>& turn) {
    state.scaled_stress = fem::rotated(state.scaled_stress, turn);
    return state;
  }
  [[nodiscard]] Response<dim> integrate(const State& start, const Increment<dim>& increment,
                                        State& trial) const {
    return integrate_elastoplastic(frame_, cone_, start, increment, trial);
  }
  [[nodiscard]] Response<dim> integrate(const State& start, const typename Cosserat<dim>::Vector& strain,
                                        State& trial) const {
    return integrate_elastoplastic(frame_, cone_, start, strain, trial);
  }

  /// The scaled stress, gamma_p, the regime.
  [[nodiscard]] static std::vector<double> packed(const State& state);
  [[nodiscard]] static State unpacked(std::span<const double> values);

  /// plastic_shear: gamma_p; regime: 0 elastic, 1 on the cone, 2 at the apex in the last step.
  static std::vector<std::string> field_names() { return {"plastic_shear", "regime"}; }
  void fields(const State& state, std::span<double> values) const;

 private:
  ElastoplasticFrame<dim> frame_;
  HardeningCone cone_;
  State initial_state_;
};

}  // namespace polargrain::fem
