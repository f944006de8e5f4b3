// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/increment.hpp"

namespace polargrain::coupler {

/// Measures strains and stresses of cells by one number each. Where the rotations of the grains are controlled, the
/// relative rotation counts as the skew strain that it is, and the mean diameter d of the grains makes curvatures
/// (kappa d) and couple stresses (m / d) comparable with strains and stresses; their work stays m kappa. Where
/// rotations are free, neither is anything the cell feels or answers.
template <int dim>
class GrainMeasure {
 public:
  using Vector = typename Cosserat<dim>::Vector;

  GrainMeasure() = default;
  /// @param mean_diameter of grains whose rotations are controlled, m; 0: they are free
  explicit GrainMeasure(double mean_diameter) : diameter_(mean_diameter) {}

  [[nodiscard]] bool controlled() const { return diameter_ > 0.0; }
  /// Strain of an increment with the curvatures times d; free rotations: the symmetric part alone. In large deformation
  /// the strain of its stretch, in the axes of its start.
  [[nodiscard]] Vector strain(const Increment<dim>& increment) const;
  /// The strain (Increment::strain) whose measured one this is.
  [[nodiscard]] Vector unmeasured(const Vector& strain) const;
  /// The size of an offset: the norm of deviatoric and skew strain and of the curvatures, and a third of its
  /// volume change, to which a packing answers with far less curvature. A rotation of both box and grains does not count.
  [[nodiscard]] double size(const Increment<dim>& offset) const;
  /// Norm of a stress, Pa: sqrt(s11^2 + s22^2 + s12^2 + s21^2 + (m1^2 + m2^2) / d^2); free rotations: of its
  /// symmetric part in the plane. In space the norm of all nine stresses and, over d, of all nine couple stresses.
  [[nodiscard]] double stress(const Vector& stress) const;

 private:
  double diameter_ = 0.0;
};

}  // namespace polargrain::coupler
