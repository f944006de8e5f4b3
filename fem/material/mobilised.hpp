// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>

#include "fem/material/stress_subspaces.hpp"

namespace polargrain::fem {

/// Friction and dilatancy that a micro scale shows at the end of a step, for a FrozenCone of the next one
/// (docs/theory/plasticity.md, B.9).
struct Mobilised {
  double friction = 0.0;   ///< mu
  double dilatancy = 0.0;  ///< beta, inside the limits
  bool clipped = false;    ///< the measured dilatancy was outside the limits
};

/// Measured dilatancies are noisy quotients of small numbers; beyond these they are not believed.
struct DilatancyLimits {
  double least = -0.5;
  double most = 1.0;
};

/// d eps - D^-1 d s in scaled components: what elasticity does not explain of a strain increment. A subspace
/// without elastic stiffness (Gc = 0) has no plastic part.
ScaledVector<double> plastic_strain(const SubspaceModuli& moduli,
                                    const ScaledVector<double>& strain_increment,
                                    const ScaledVector<double>& stress_increment);

/// mu = (q - k) / (-p) and beta = d eps_v^p / d gamma_p of a micro scale that has an out-of-plane stress,
/// with the invariants of B.1.
/// @param stress    scaled average stress at the end of the step, Pa
/// @param plastic   scaled plastic strain of the step, as plastic_strain() gives it
/// @param cohesion  k of the frozen cone, Pa
/// @return nothing when there is nothing to read: no plastic shear, or a mean stress that is not compressive;
/// the caller then keeps the values it has.
std::optional<Mobilised> mobilised(const SubspaceModuli& moduli, const ScaledVector<double>& stress,
                                   const ScaledVector<double>& plastic, double cohesion,
                                   const DilatancyLimits& limits = {});

/// The same for a micro scale in the plane (discs), from s11, s22, s12, s21 only: the mobilised in-plane
/// angles, matched to the cone by B.3.
/// @return nothing as above, and when the in-plane stress has a tensile or zero principal value.
std::optional<Mobilised> mobilised_in_plane(const ScaledVector<double>& stress,
                                            const ScaledVector<double>& plastic,
                                            const DilatancyLimits& limits = {});

}  // namespace polargrain::fem
