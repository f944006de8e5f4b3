// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <memory>

#include "fem/interface/friction_curve.hpp"

namespace polargrain::fem {

/// Stiffness and strength of an interface: Coulomb friction with dilation, and a tension that ends in a gap.
struct InterfaceParameters {
  double normal_stiffness = 0.0;     ///< kn, Pa/m, positive
  double shear_stiffness = 0.0;      ///< kt, Pa/m, positive
  double tan_friction = 0.0;         ///< tan(delta), not negative
  double tan_dilation = 0.0;         ///< tan(psi), from 0 to tan_friction
  double cohesion = 0.0;             ///< Pa, not negative
  double tension = 0.0;              ///< tensile strength ft, Pa, at most cohesion / tan_friction
  double dilation_until = HUGE_VAL;  ///< slip at which dilation ends, m
  bool cohesion_lasts = false;       ///< also where it has been open
  /// Friction and dilation over the slip, in the place of tan_friction, tan_dilation and dilation_until; null: these.
  std::shared_ptr<const FrictionCurve> over_slip = {};
};

/// Jumps and stress vectors in the axes of the face: tangential components first, the normal one last.
template <int dim>
using FaceVector = Eigen::Matrix<double, dim, 1>;

/// The memory of a point of an interface.
template <int dim>
struct InterfaceState {
  FaceVector<dim> initial_traction = FaceVector<dim>::Zero();  ///< Pa, at a jump of zero
  FaceVector<dim> plastic_jump = FaceVector<dim>::Zero();      ///< m: of slip and dilation
  double slip = 0.0;                                           ///< way of sliding so far, m
  bool has_opened = false;                                     ///< tension and cohesion are gone
};

enum class Contact { sticks, slips, open };

/// Answer of a point of an interface to a jump.
template <int dim>
struct InterfaceAnswer {
  FaceVector<dim> traction;                 ///< Pa, acts on side b as -traction; tension positive
  Eigen::Matrix<double, dim, dim> tangent;  ///< d traction / d jump, Pa/m; not symmetric where it slips
  Contact contact;
  InterfaceState<dim> state;  ///< to be committed
};

/// tan(delta) after a way of sliding, m.
double tan_friction_at(const InterfaceParameters& parameters, double slip);

/// Closed-form return to |t_t| + t_n tan(delta) <= c, t_n <= ft from the trial stress t_0 + k (g - g_p). Sliding opens by
/// tan(psi) times its way. An open point has no stress; it closes where it opened, and without shear. Under a curve over the slip
/// the return ends at the first slip whose friction carries the shear; where friction falls faster than the shear stiffness
/// follows, that is behind the fall.
/// @param jump displacement of side b less that of side a, m, normal from a to b
/// @param committed state at the start of the step
template <int dim>
InterfaceAnswer<dim> respond(const InterfaceParameters& parameters, const InterfaceState<dim>& committed,
                             const FaceVector<dim>& jump);

/// Width of the gap at a point that is open, m; 0 for a point that is not.
template <int dim>
double gap(const InterfaceParameters& parameters, const InterfaceAnswer<dim>& answer,
           const FaceVector<dim>& jump);

/// |t_t| / (c - t_n tan(delta)): 1 where it slips, 0 where it is open.
template <int dim>
double mobilised_share(const InterfaceParameters& parameters, const InterfaceAnswer<dim>& answer);

}  // namespace polargrain::fem
