// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>

#include "fem/material/cone.hpp"

namespace polargrain::fem {

/// Mohr-Coulomb strength as it is measured: angles in degrees, cohesion in Pa.
struct MohrCoulomb {
  double friction_angle = 0.0;   ///< phi, degrees, in [0, 90)
  double dilatancy_angle = 0.0;  ///< psi, degrees, in (-90, 90)
  double cohesion = 0.0;         ///< c, Pa, >= 0
};

/// The cone whose collapse in plane strain is the given Mohr-Coulomb strength (docs/theory/plasticity.md,
/// B.3). Exact for developed plastic flow (d eps_33^p = 0) with non-associated flow.
/// @throws InputError when an angle or the cohesion is outside its range.
FrozenCone cone_from_plane_strain(const MohrCoulomb& strength);

/// The inverse of cone_from_plane_strain. Nothing when the cone does not collapse in plane strain at all
/// (sin(phi) would reach 1) or when |M_psi| is outside the plane-strain range.
std::optional<MohrCoulomb> plane_strain_from_cone(const FrozenCone& cone);

/// The cone through the triaxial compression corners: M = 6 sin / (3 - sin). Far too strong in plane strain.
/// @throws InputError as above.
FrozenCone cone_from_triaxial_compression(const MohrCoulomb& strength);

/// The cone through the triaxial extension corners: M = 6 sin / (3 + sin).
/// @throws InputError as above.
FrozenCone cone_from_triaxial_extension(const MohrCoulomb& strength);

/// The inscribed cone: M = sqrt3 sin / sqrt(1 + sin^2 / 3). In plane strain exact for associated flow.
/// @throws InputError as above.
FrozenCone inner_cone(const MohrCoulomb& strength);

/// The states in which a cone has the strength of Mohr-Coulomb. A circular cone has it in one of them alone.
enum class ConeMatch { triaxial_compression, triaxial_extension, plane_strain, inner };

FrozenCone matched_cone(const MohrCoulomb& strength, ConeMatch match);

/// Friction angle (degrees) of a cone in triaxial extension, sin = 3 M / (6 - M); nothing where the cone has no limit there,
/// from M = 3/2 on.
std::optional<double> angle_in_extension(const FrozenCone& cone);

/// Strength as functions of the accumulated plastic shear, in the units of MohrCoulomb.
struct MohrCoulombHardening {
  PiecewiseLinear friction_angle;   ///< degrees
  PiecewiseLinear dilatancy_angle;  ///< degrees
  PiecewiseLinear cohesion;         ///< Pa
};

/// tan(friction angle) and cohesion divided by a factor. The dilatancy stays, or is the new friction angle where that is smaller.
MohrCoulomb divided(const MohrCoulomb& strength, double factor);
/// The same at every knot of the three functions.
MohrCoulombHardening divided(const MohrCoulombHardening& strength, double factor);

/// Matches the cone at every knot of the three functions; between knots the cone's own parameters (M_phi,
/// M_psi, k) are straight, not the angles. Knots of one function become knots of all, because M_phi depends
/// on the dilatancy as well.
/// @throws InputError as cone_from_plane_strain.
HardeningCone hardening_cone_from_plane_strain(const MohrCoulombHardening& strength);
/// The same for any match.
HardeningCone hardening_cone(const MohrCoulombHardening& strength, ConeMatch match);

}  // namespace polargrain::fem
