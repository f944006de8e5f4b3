// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>

#include "common/cosserat.hpp"

namespace polargrain::fem {

/// In explicit steps, of the growth of a stress over a step: shears that are elastic until they slip have no other damping. The
/// lag of boxes behind other strains then drives waves until they slip (docs/theory/spread.md), and the waves of an onset stay.
/// A shear wave of ten elements loses a quarter of its height in a period, shorter ones lose more. Even slip feels nothing of it.
/// Less leaves waves of single elements in columns of boxes (0.25, 0.35). More makes steps unstable where boxes stiffen (1).
inline constexpr double kDampingOfSteps = 0.5;

/// How one point answers to a slip that is given from outside.
template <int dim>
struct SlipAnswer {
  using Vector = typename Cosserat<dim>::Vector;
  double drive =
      0.0;  ///< stress along the slip less strength, Pa: positive where the point would slip further
  double scale = 0.0;                       ///< sum of the absolute terms of the drive, Pa
  Vector stress_by_slip = Vector::Zero();   ///< d stress / d slip at fixed strain
  Vector drive_by_strain = Vector::Zero();  ///< d drive / d strain at fixed slip
  double drive_by_slip = 0.0;               ///< d drive / d slip, Pa; at fixed strain
};

/// The ability of a material whose plastic strain follows a slip given from outside, point by point, in place of its own yield
/// condition: a balance at the nodes (spread/spread_slip.hpp) finds the slip. Response::tangent is then the one at fixed slip.
template <int dim>
class SlipDriven {
 public:
  virtual ~SlipDriven() = default;
  /// Growth of the slip over the step, one a point: the evaluations to come take it, until the next commit or revert.
  virtual void set_slips(std::span<const double> increments) = 0;
  /// Of the last evaluation; behind commit and revert of the committed state. One a point.
  [[nodiscard]] virtual std::span<const SlipAnswer<dim>> slip_answers() const = 0;
  /// Whether the steps to come are explicit (Asking::once).
  [[nodiscard]] virtual bool is_explicit() const = 0;
  /// -d drive / d slip of a law without hardening, Pa: overstresses are measured by it.
  [[nodiscard]] virtual double slip_stiffness() const = 0;
};

}  // namespace polargrain::fem
