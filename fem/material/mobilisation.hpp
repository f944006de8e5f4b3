// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <type_traits>
#include <vector>

#include "fem/material/cone.hpp"
#include "fem/material/cone_matching.hpp"
#include "fem/material/mobilised.hpp"
#include "fem/material/rotation.hpp"
#include "fem/material/unloading.hpp"

namespace polargrain::fem {

/// How friction and dilatancy are read from a micro scale, step after step (docs/theory/plasticity.md, B.9).
struct MobilisationOptions {
  /// The dilatancy is the slope over this many increments of the micro scale, at least 1.
  int window = 5;
  DilatancyLimits limits;
  double cohesion = 0.0;          ///< of Mohr-Coulomb, Pa; small and numerical
  double initial_friction = 0.0;  ///< angle, rad: the cone before anything is read
  /// The state in which the cone has that angle and cohesion.
  ConeMatch match = ConeMatch::plane_strain;
  /// Plastic shear over which a difference of mean stress between micro scale and law is worked off by the
  /// dilatancy, or the shear of a step where that is more; 0: never (the published scheme).
  double drift_shear = 0.01;
};

/// One increment of the micro scale. Stresses have all of s11, s22, s33 (docs/theory/plasticity.md, B.9 on
/// discs) and are in the axes of the start of the step where the material rotates (rotation.hpp).
template <int dim>
struct MicroStep {
  ScaledVector<double, dim> strain;         ///< scaled
  ScaledVector<double, dim> stress_before;  ///< scaled, Pa
  ScaledVector<double, dim> stress_after;   ///< scaled, Pa
  double macro_mean = 0.0;                  ///< mean stress of the macro law at the end, Pa
  bool macro_plastic = false;               ///< the macro law yielded in this step
};

/// The knowledge of one point about its micro scale: a plain value.
template <int dim>
struct Mobilisation {
  /// A point of the window: plastic strain of the micro scale over a measure of its deformation.
  struct Sample {
    double deformation = 0.0;  ///< sum of the norms of the strain increments
    ScaledVector<double, dim> plastic_strain = ScaledVector<double, dim>::Zero();
  };

  FrozenCone cone;              ///< for the next step of the macro law
  double micro_friction = 0.0;  ///< mu, as the micro scale itself showed it last
  bool limited = false;         ///< the value read last was outside the limits, or the micro scale in tension
  /// Oldest first, at most window + 1, all of one loading; empty in unloading.
  std::vector<Sample> samples;
  /// How the micro scale answered in the last step, where the macro law did not flow and the micro scale was inside of the
  /// law's cone too; else nothing.
  std::optional<UnloadingMode> unloading;
};

/// Before anything has been read: the cone of the initial friction without dilatancy.
/// @throws InputError when the angle or the cohesion is outside its range.
template <int dim = 2>
Mobilisation<dim> initial_mobilisation(const MobilisationOptions& options);

/// The knowledge of the point, turned with the material: the plastic strains of the window.
template <int dim>
Mobilisation<dim> rotated(Mobilisation<dim> mobilisation, const std::type_identity_t<Turn<dim>>& turn);

/// The knowledge of a point after one more increment of its micro scale.
///
/// The window holds the increments of one loading: s : d eps + m . d kappa > 0 with the deviators of stress and strain. In
/// unloading it is emptied and the cone stays. The cone also stays while the macro law is elastic, and
/// friction does not fall when the micro scale, loaded again, is still on its way up to it: it falls only
/// when the micro scale loses strength while it is being loaded (softening).
/// Grains that have come out of contact (less than a twentieth of the law's pressure) show nothing: friction stays, and the law contracts as drift_shear
/// asks until they carry again.
template <int dim>
Mobilisation<dim> advance(const Mobilisation<dim>& start, const MicroStep<dim>& step,
                          const SubspaceModuli& moduli, const MobilisationOptions& options);

}  // namespace polargrain::fem
