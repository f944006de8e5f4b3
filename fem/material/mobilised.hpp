// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>

#include "fem/material/cone.hpp"
#include "fem/material/stress_subspaces.hpp"

namespace polargrain::fem {

/// Friction and dilatancy that a micro scale shows at the end of a step, for a FrozenCone of the next one
/// (docs/theory/plasticity.md, B.9).
struct Mobilised {
  double friction = 0.0;   ///< mu
  double dilatancy = 0.0;  ///< beta, inside the limits
  bool clipped = false;    ///< the measured dilatancy was outside the limits
};

/// Measured dilatancies are noisy quotients of small numbers; beyond these they are not believed. Beside
/// them, dilatancy never exceeds friction: flow could then create energy.
struct DilatancyLimits {
  double least = -0.5;
  double most = 1.0;
};

/// d eps - D^-1 d s in scaled components: the part of a strain increment that is not elastic. A subspace
/// without elastic stiffness (Gc = 0) has no plastic part.
template <int dim = 2>
ScaledVector<double, dim> plastic_strain(const SubspaceModuli& moduli,
                                         const ScaledVector<double, dim>& strain_increment,
                                         const ScaledVector<double, dim>& stress_increment);

/// mu = (q - k) / (-p) of a micro scale that has an out-of-plane stress, with the invariants of B.1; nothing
/// when the mean stress is not compressive or q is below k.
/// @param stress scaled average stress, Pa @param cohesion k of the cone, Pa
template <int dim = 2>
std::optional<double> cone_friction(const SubspaceModuli& moduli, const ScaledVector<double, dim>& stress,
                                    double cohesion);

/// Shear of a scaled strain increment by the measure that gamma_p has of a plastic one (B.1).
template <int dim = 2>
double shear_strain(const SubspaceModuli& moduli, const ScaledVector<double, dim>& strain);

/// beta = d eps_v^p / d gamma_p of a scaled plastic strain, or of its rate; nothing without plastic shear.
template <int dim = 2>
std::optional<double> cone_dilatancy(const SubspaceModuli& moduli, const ScaledVector<double, dim>& plastic);

/// mu and beta of one step of a micro scale that has an out-of-plane stress; nothing when one of them cannot
/// be read: the caller then keeps the values it has. @param cohesion k of the frozen cone, Pa
template <int dim = 2>
std::optional<Mobilised> mobilised(const SubspaceModuli& moduli, const ScaledVector<double, dim>& stress,
                                   const ScaledVector<double, dim>& plastic, double cohesion,
                                   const DilatancyLimits& limits = {});

/// The same for a micro scale in the plane (discs), from s11, s22, s12, s21 only: the mobilised in-plane
/// angles, matched to the cone by B.3, which holds in developed flow.
/// @return nothing as above, and when the in-plane stress has a tensile or zero principal value.
std::optional<Mobilised> mobilised_in_plane(const ScaledVector<double>& stress,
                                            const ScaledVector<double>& plastic,
                                            const DilatancyLimits& limits = {});

/// beta inside its limits, with mu.
Mobilised within(double friction, double dilatancy, const DilatancyLimits& limits);

}  // namespace polargrain::fem
