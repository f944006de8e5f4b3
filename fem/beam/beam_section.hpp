// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <cmath>

namespace polargrain::fem {

/// A section of a beam; in the plane each per m of thickness (a plate in plane strain: E t / (1 - nu^2)).
struct BeamSection {
  double axial_stiffness = 0.0;           ///< EA, N, positive
  double bending_stiffness = 0.0;         ///< EI, N m^2, positive
  double shear_stiffness = 0.0;           ///< GA of the shear area, N, positive
  double plastic_moment = HUGE_VAL;       ///< Mp, N m, positive
  double plastic_axial_force = HUGE_VAL;  ///< Np, N: at it no moment is left
};

/// Strains of a beam, and the forces conjugate to them: axial, shear, bending.
using BeamVector = Eigen::Vector3d;

struct BeamAnswer {
  BeamVector forces;         ///< N (tension positive), V, M
  Eigen::Matrix3d tangent;   ///< d forces / d strains
  double plastic_curvature;  ///< 1/m, to be committed
};

/// N = EA eps, V = GA gamma, M = EI (kappa - kappa_p) with |M| <= Mp (1 - |N| / Np). N and V are elastic.
/// The tangent keeps kYieldingStiffness of EI where the section yields, so that a mechanism does not make it singular.
BeamAnswer respond(const BeamSection& section, double plastic_curvature, const BeamVector& strain);

inline constexpr double kYieldingStiffness = 1e-6;

}  // namespace polargrain::fem
