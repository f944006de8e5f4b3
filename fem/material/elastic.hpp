// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "common/increment.hpp"
#include "common/response.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::fem {

/// Isotropic Cosserat elasticity in plane strain (docs/theory.md, A.4).
struct ElasticParameters {
  double young_modulus = 0.0;                ///< E, Pa
  double poisson_ratio = 0.0;                ///< nu, in (-1, 0.5)
  double cosserat_shear_modulus = 0.0;       ///< Gc, Pa
  double internal_length = 0.0;              ///< lc, m; the couple modulus is 2 G lc^2
  Vector7 initial_stress = Vector7::Zero();  ///< order of common/increment.hpp, Pa and N/m
};

/// The faults of the parameters, one message each; empty when the law is usable. Gc = 0 and lc = 0
/// are allowed here (the classical limits); a mesh with rotations then has rotations that nothing holds.
std::vector<std::string> faults(const ElasticParameters& parameters);

/// d stress / d strain for the unscaled strain and stress vectors (docs/theory.md, A.4).
Matrix7 elastic_stiffness(const ElasticParameters& parameters);

/// Linear elasticity, from an initial stress, as a local law (see local_material.hpp).
class ElasticLaw {
 public:
  struct State {
    Vector7 stress;
  };

  /// @throws RunError with all faults of the parameters.
  explicit ElasticLaw(const ElasticParameters& parameters);

  [[nodiscard]] State initial_state() const { return {initial_stress_}; }
  [[nodiscard]] static State initial_state(const Vector7& stress) { return {stress}; }
  [[nodiscard]] static State rotated(const State& state, double angle) {
    return {fem::rotated(state.stress, angle)};
  }
  [[nodiscard]] static std::vector<double> packed(const State& state) {
    return {state.stress.begin(), state.stress.end()};
  }
  [[nodiscard]] static State unpacked(std::span<const double> values) {
    return {Vector7(Eigen::Map<const Vector7>(values.data()))};
  }
  [[nodiscard]] Response integrate(const State& start, const Increment& increment, State& trial) const {
    return integrate(start, increment.strain(), trial);
  }
  [[nodiscard]] Response integrate(const State& start, const Vector7& strain, State& trial) const;

 private:
  Vector7 initial_stress_;
  Matrix7 stiffness_;
};

}  // namespace polargrain::fem
