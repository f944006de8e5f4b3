// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "fem/material/consistent_tangent.hpp"
#include "fem/material/elastic.hpp"

namespace polargrain::fem {

/// Generalised pressure-dependent elastoplastic Cosserat material (docs/theory/plasticity.md, B.1 to B.6).
struct ElastoplasticParameters {
  /// Elasticity and the initial stress. With cosserat_shear_modulus = 0 the initial stress must have no skew
  /// shear, with internal_length = 0 no couple stress: nothing could carry their change.
  ElasticParameters elastic;
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
std::vector<std::string> faults(const ElastoplasticParameters& parameters);

/// The least value of 3G + K M_phi (M_psi + d lambda M_psi') - M_phi' p + k' over all pieces of the hardening
/// functions at mean stress `mean` (Pa, tension positive) for small steps, Pa; must be positive (B.2).
double softening_reserve(const HardeningCone& cone, const SubspaceModuli& moduli, double mean);

/// The material state of a point: everything that the next step starts from.
struct ElastoplasticState {
  ScaledVector<double> scaled_stress = ScaledVector<double>::Zero();  ///< couple stresses over lc, all Pa
  double gamma_p = 0.0;             ///< accumulated plastic shear = sum of d lambda
  Regime regime = Regime::elastic;  ///< how the last step ended
};

/// The frame that turns unscaled increments into scaled ones and holds the elastic constants of the return mapping.
struct ElastoplasticFrame {
  SubspaceModuli moduli;
  double length = 0.0;  ///< lc, m
  double apex_stiffness_share = 0.0;

  /// Stress with couple stresses in N/m of a scaled stress.
  [[nodiscard]] Vector7 unscaled_stress(const ScaledVector<double>& scaled) const;
};

/// One step of one point with any cone. Never throws; a step without an answer is Quality::failed and leaves
/// `trial` equal to `start`. Response::tangent is consistent with the step (plus the apex share).
Response integrate_elastoplastic(const ElastoplasticFrame& frame, const HardeningCone& cone,
                                 const ElastoplasticState& start, const Increment& increment,
                                 ElastoplasticState& trial);
/// The same with mobilised friction and dilatancy given from outside for this step (B.9).
Response integrate_elastoplastic(const ElastoplasticFrame& frame, const FrozenCone& cone,
                                 const ElastoplasticState& start, const Increment& increment,
                                 ElastoplasticState& trial);

/// The same along a strain (order of Component) whose eps_33 need not be zero.
Response integrate_elastoplastic(const ElastoplasticFrame& frame, const HardeningCone& cone,
                                 const ElastoplasticState& start, const Vector7& strain,
                                 ElastoplasticState& trial);

/// The elastoplastic material as a local law (local_material.hpp).
class ElastoplasticLaw {
 public:
  using State = ElastoplasticState;

  /// @throws RunError with all faults of the parameters.
  explicit ElastoplasticLaw(const ElastoplasticParameters& parameters);

  [[nodiscard]] State initial_state() const { return initial_state_; }
  /// @param stress with couple stresses in N/m. A stress outside the cone is returned to it in the first
  /// step.
  [[nodiscard]] State initial_state(const Vector7& stress) const;
  [[nodiscard]] static State rotated(State state, double angle) {
    state.scaled_stress = fem::rotated(state.scaled_stress, angle);
    return state;
  }
  [[nodiscard]] Response integrate(const State& start, const Increment& increment, State& trial) const {
    return integrate_elastoplastic(frame_, cone_, start, increment, trial);
  }
  [[nodiscard]] Response integrate(const State& start, const Vector7& strain, State& trial) const {
    return integrate_elastoplastic(frame_, cone_, start, strain, trial);
  }

  /// The scaled stress, gamma_p, the regime.
  [[nodiscard]] static std::vector<double> packed(const State& state);
  [[nodiscard]] static State unpacked(std::span<const double> values);

  /// plastic_shear: gamma_p; regime: 0 elastic, 1 on the cone, 2 at the apex in the last step.
  static std::vector<std::string> field_names() { return {"plastic_shear", "regime"}; }
  void fields(const State& state, std::span<double> values) const;

 private:
  ElastoplasticFrame frame_;
  HardeningCone cone_;
  State initial_state_;
};

}  // namespace polargrain::fem
