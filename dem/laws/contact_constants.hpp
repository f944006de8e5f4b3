// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Stiffnesses, dashpots and limits of a contact from the parameters of its types (docs/theory/grains.md, D.2). Discs ask
// for them in every step; lists of spheres keep them.
#include "dem/lanes/vectors.hpp"
#include "dem/laws/law_settings.hpp"

namespace polargrain::dem {
namespace {

/// Filled where it stands: GCC copies structures of vectors through memory.
template <typename Number>
struct Stiffnesses {
  Number normal{}, tangential{};                  ///< N/m
  Number normal_dashpot{}, tangential_dashpot{};  ///< N s/m
};

/// The sizes of two grains that meet. Filled number by number: zeros for a whole structure would be written to memory first.
template <typename Number>
struct GrainPair {
  Number radius_first, radius_second;                    ///< m
  Number harmonic;                                       ///< r_1 r_2 / (r_1 + r_2), m
  Number inverse_mass_first, inverse_mass_second;        ///< 1/kg; dashpots alone ask for masses
  Number inverse_inertia_first, inverse_inertia_second;  ///< 1/(kg m^2)

  [[nodiscard]] POLARGRAIN_INLINE Number effective_mass() const {
    return 1.0 / (inverse_mass_first + inverse_mass_second);
  }
  [[nodiscard]] POLARGRAIN_INLINE Number effective_inertia() const {
    return 1.0 / (inverse_inertia_first + inverse_inertia_second);
  }
};

/// Of the normal law. @param damped there are dashpots @param absolute hooke/stiffness: they do not scale with the mass
/// @param overlap that Hertz's law asks for, m
template <NormalLaw Law, typename Number>
POLARGRAIN_INLINE void stiffnesses_of(const ParametersOf<Number>& p, bool damped, bool absolute,
                                      const GrainPair<Number>& grains, Number overlap,
                                      Stiffnesses<Number>& made) {
  if constexpr (Law == NormalLaw::hooke_radii) {
    made.normal = p.normal * grains.harmonic;
    made.tangential = p.tangential * made.normal;
    if (!damped) return;
    const Number mass = grains.effective_mass();
    made.normal_dashpot = 2.0 * p.normal_damping * root(made.normal * mass);
    made.tangential_dashpot = 2.0 * p.tangential_damping * root(made.tangential * mass);
  } else if constexpr (Law == NormalLaw::hooke_stiffness) {
    made.normal = p.normal;
    made.tangential = p.tangential;
    if (!damped) return;
    const Number mass = absolute ? all<Number>(1.0) : grains.effective_mass();
    made.normal_dashpot = mass * p.normal_damping;
    made.tangential_dashpot = mass * p.tangential_damping;
  } else {
    const Number stiffening = root(grains.harmonic * overlap);
    made.normal = p.normal * stiffening;
    made.tangential = p.tangential * stiffening;
    if (!damped) return;
    const Number factor = root(stiffening * grains.effective_mass());
    made.normal_dashpot = p.normal_damping * factor;
    made.tangential_dashpot = p.tangential_damping * factor;
  }
}

/// r_c of the rolling law, m.
template <RollingLaw Law, typename Number>
POLARGRAIN_INLINE Number rolling_radius(const LawSettings& settings, const GrainPair<Number>& grains) {
  if constexpr (Law == RollingLaw::epsd2) return grains.harmonic;
  return settings.mean_radius ? 0.5 * (grains.radius_first + grains.radius_second) : grains.harmonic;
}

/// Of the rolling law, N m. @param kt tangential stiffness, N/m @param radius r_c, m
template <RollingLaw Law, typename Number>
POLARGRAIN_INLINE Number rolling_stiffness_of(const ParametersOf<Number>& p, Number kt, Number radius) {
  if constexpr (Law == RollingLaw::epsd2) return kt * radius * radius;
  return p.rolling_stiffness * kt * radius * radius;
}

/// Of the rolling resistance, N m s. @param stiffness of rolling, N m
template <typename Number>
POLARGRAIN_INLINE Number rolling_dashpot_of(const ParametersOf<Number>& p, Number stiffness,
                                            const GrainPair<Number>& grains) {
  return 2.0 * p.rolling_damping * root(stiffness * grains.effective_inertia());
}

/// Of the rolling friction force, N s/m. @param stiffness of that force, N/m
template <typename Number>
POLARGRAIN_INLINE Number force_dashpot_of(const ParametersOf<Number>& p, Number stiffness,
                                          const GrainPair<Number>& grains) {
  return 2.0 * p.rolling_force_damping * root(stiffness * grains.effective_mass());
}

}  // namespace
}  // namespace polargrain::dem
