// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "common/increment.hpp"
#include "common/response.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::fem {

/// Isotropic Cosserat elasticity, in the plane in plane strain (docs/theory.md, A.4).
template <int dim>
struct ElasticParameters {
  double young_modulus = 0.0;           ///< E, Pa
  double poisson_ratio = 0.0;           ///< nu, in (-1, 0.5)
  double cosserat_shear_modulus = 0.0;  ///< Gc, Pa
  double internal_length = 0.0;         ///< lc, m; the couple modulus gamma is 2 G lc^2
  /// In the order of Cosserat<dim>, Pa and N/m.
  typename Cosserat<dim>::Vector initial_stress = Cosserat<dim>::Vector::Zero();
  /// alpha and beta over gamma in m_ij = alpha kappa_kk d_ij + beta kappa_ji + gamma kappa_ij. The plane does not feel them.
  double couple_trace_ratio = 0.0;
  double couple_transpose_ratio = 0.0;
};

/// The faults of the parameters, one message each; empty when the law is usable. Gc = 0 and lc = 0
/// are allowed here (the classical limits); a mesh with rotations then has rotations that nothing holds.
template <int dim>
std::vector<std::string> faults(const ElasticParameters<dim>& parameters);

/// d stress / d strain for the unscaled strain and stress vectors (docs/theory.md, A.4).
template <int dim>
typename Cosserat<dim>::Matrix elastic_stiffness(const ElasticParameters<dim>& parameters);

/// Linear elasticity, from an initial stress, as a local law (see local_material.hpp).
template <int dim>
class ElasticLaw {
 public:
  static constexpr int dimension = dim;
  using Vector = typename Cosserat<dim>::Vector;

  struct State {
    Vector stress;
  };

  /// @throws RunError with all faults of the parameters.
  explicit ElasticLaw(const ElasticParameters<dim>& parameters);

  [[nodiscard]] State initial_state() const { return {initial_stress_}; }
  [[nodiscard]] static State initial_state(const Vector& stress) { return {stress}; }
  [[nodiscard]] static State rotated(const State& state, const Turn<dim>& turn) {
    return {fem::rotated(state.stress, turn)};
  }
  [[nodiscard]] static std::vector<double> packed(const State& state) {
    return {state.stress.begin(), state.stress.end()};
  }
  [[nodiscard]] static State unpacked(std::span<const double> values) {
    return {Vector(Eigen::Map<const Vector>(values.data()))};
  }
  [[nodiscard]] Response<dim> integrate(const State& start, const Increment<dim>& increment,
                                        State& trial) const {
    return integrate(start, increment.strain(), trial);
  }
  [[nodiscard]] Response<dim> integrate(const State& start, const Vector& strain, State& trial) const;

 private:
  Vector initial_stress_;
  typename Cosserat<dim>::Matrix stiffness_;
};

}  // namespace polargrain::fem
