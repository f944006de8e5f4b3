// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cmath>
#include <complex>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "fem/material/cone_matching.hpp"
#include "fem/material/consistent_tangent.hpp"

namespace polargrain::fem::test {

/// One choice of strength and invariant weights to try the return mapping on.
struct Variant {
  std::string name;
  HardeningCone cone;
  InvariantWeights weights;
};
inline void PrintTo(const Variant& variant, std::ostream* out) {
  *out << variant.name;
}

inline const InvariantWeights kStatic{3.0 / 8.0, 1.0 / 8.0, 1.0 / 4.0};
inline const InvariantWeights kKinematic{3.0 / 4.0, -1.0 / 4.0, 1.0 / 8.0};

inline ElasticParameters<2> sand_elasticity() {
  ElasticParameters<2> elastic;
  elastic.young_modulus = 50e6;
  elastic.poisson_ratio = 0.3;
  elastic.cosserat_shear_modulus = 10e6;
  elastic.internal_length = 1e-3;
  return elastic;
}

/// The table of docs/theory/plasticity.md, B.7, and a tabulated strength that hardens, then softens.
inline std::vector<Variant> variants() {
  using Ramp = PiecewiseLinear;
  const auto ramp = [](double start, double end) { return Ramp::ramp(start, end, 0.3); };
  const auto matched = [](Ramp phi, Ramp psi, Ramp c) {
    return hardening_cone_from_plane_strain({std::move(phi), std::move(psi), std::move(c)});
  };
  const Ramp table({{0.0, 25.0}, {0.02, 38.0}, {0.04, 40.0}, {0.1, 33.0}});
  return {{"perfect_associated", matched(30.0, 30.0, 50e3), {}},
          {"perfect_non_associated", matched(35.0, 5.0, 50e3), {}},
          {"cohesion_softening", matched(30.0, 5.0, ramp(100e3, 20e3)), {}},
          {"all_softening", matched(ramp(40.0, 32.0), ramp(10.0, 0.0), ramp(100e3, 20e3)), {}},
          {"friction_hardening", matched(ramp(20.0, 40.0), 5.0, 50e3), {}},
          {"kinematic_weights", matched(ramp(38.0, 30.0), 5.0, ramp(100e3, 20e3)), kKinematic},
          {"static_weights", matched(35.0, ramp(10.0, 0.0), ramp(100e3, 20e3)), kStatic},
          {"frictionless_softening", {0.0, 0.0, ramp(100e3, 50e3)}, {}},
          {"negative_dilatancy", matched(30.0, -10.0, 50e3), {}},
          {"frozen", {0.9, 0.25, 1e3}, {}},
          {"frozen_kinematic_weights", {0.9, 0.25, 1e3}, kKinematic},
          {"tabulated_friction", matched(table, 5.0, 20e3), kStatic}};
}

/// Fixed sequence of random elastic strains, |eps| from 10^-3.5 to 10^-1.5 in every direction, and of gamma_p
/// from 0 to 0.05.
class RandomStates {
 public:
  explicit RandomStates(unsigned seed) : generator_(seed) {}

  ScaledVector<double> strain() {
    ScaledVector<double> direction;
    for (double& component : direction) {
      component = uniform(-1.0, 1.0);
    }
    return std::pow(10.0, uniform(-3.5, -1.5)) * direction.normalized();
  }
  double gamma_p() { return uniform(0.0, 0.05); }
  /// Own mapping of the generator's bits: the library's distributions differ between implementations.
  double uniform(double from, double to) {
    return from + (to - from) * (static_cast<double>(generator_()) / 4294967296.0);
  }

 private:
  std::mt19937 generator_;
};

/// The whole step as a function of the elastic trial strain.
template <class Scalar, class ConeAt>
ConeReturn<Scalar> step(const ScaledVector<Scalar>& strain, double gamma_p, const SubspaceModuli& moduli,
                        const ConeAt& cone) {
  return return_to_cone(elastic_stress(moduli, strain), Scalar(gamma_p), moduli, cone);
}

/// Derivative of the step by a complex step of 1e-30: exact to rounding, independent of the closed form.
template <class ConeAt>
ScaledMatrix<double> complex_step_tangent(const ScaledVector<double>& strain, double gamma_p,
                                          const SubspaceModuli& moduli, const ConeAt& cone) {
  using Complex = std::complex<double>;
  constexpr double kStep = 1e-30;
  ScaledMatrix<double> tangent;
  for (int column = 0; column < 7; ++column) {
    ScaledVector<Complex> perturbed = strain.cast<Complex>();
    perturbed(column) += Complex(0.0, kStep);
    tangent.col(column) = step(perturbed, gamma_p, moduli, cone).stress.imag() / kStep;
  }
  return tangent;
}

}  // namespace polargrain::fem::test
