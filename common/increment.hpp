// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "common/cell_increment.hpp"
#include "common/cosserat.hpp"
#include "common/record.hpp"

namespace polargrain {

/// Order of the components of every strain and stress vector of the plane (mechanics A.4, but unscaled: curvatures in 1/m,
/// couple stresses in N/m). First index of a stress: normal of the face; second: direction of the force.
enum Component : int { k11 = 0, k22 = 1, k33 = 2, k12 = 3, k21 = 4, kCurvature1 = 5, kCurvature2 = 6 };

/// The shape of the body that the gradients of an increment refer to, and with it who turns the stress
/// (docs/theory/solver.md, small and large deformation).
enum class Configuration {
  fixed,  ///< small deformation: the shape at the start of the run; no stress turns with the continuum
  start   ///< large deformation: the shape at the start of the step; stresses turn
};

/// The change over a load step that a material point feels, counted from the start of the step.
template <int dim>
struct Increment;

template <>
struct Increment<2> {
  /// h(i,j) = d u_i / d x_j, dimensionless.
  Eigen::Matrix2d displacement_gradient = Eigen::Matrix2d::Zero();
  /// Change of the micro-rotation about e_3, counter-clockwise positive, in rad.
  double micro_rotation = 0.0;
  /// kappa_i = d w / d x_i, in rad/m.
  Eigen::Vector2d curvature = Eigen::Vector2d::Zero();
  /// Not in the description below: increments that travel to cells are already referred to their shape.
  Configuration configuration = Configuration::fixed;

  /// Cosserat strain (mechanics A.1): eps_12 = h21 - w, eps_21 = h12 + w, eps_33 = 0 (plane strain). Of large
  /// deformation take the strain of the stretch instead (fem/material/rotation.hpp).
  [[nodiscard]] Vector7 strain() const {
    Vector7 e;
    e << displacement_gradient(0, 0), displacement_gradient(1, 1), 0.0,
        displacement_gradient(1, 0) - micro_rotation, displacement_gradient(0, 1) + micro_rotation,
        curvature(0), curvature(1);
    return e;
  }
};

/// In space it holds the members of a cell's increment.
template <>
struct Increment<3> : CellIncrement {
  Configuration configuration = Configuration::fixed;

  /// Cosserat strain: eps_ij = h_ji - e_ijk w_k, then kappa_ij = d w_j / d x_i (Cosserat<3>).
  [[nodiscard]] Vector18 strain() const {
    using Space = Cosserat<3>;
    Vector18 e;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        double skew = 0.0;
        for (int k = 0; k < 3; ++k) skew += permutation(i, j, k) * rotation(k);
        e(Space::stress_place(i, j)) = displacement_gradient(j, i) - skew;
        e(Space::couple_place(i, j)) = curvature(j, i);
      }
    return e;
  }
};

template <RecordOf<Increment<2>> Record, class Visit>
void describe(Record& increment, Visit&& visit) {
  visit(FieldNotes{"h", "1", "displacement gradient, h_ij = d u_i / d x_j", "11 12 21 22"},
        increment.displacement_gradient);
  visit(FieldNotes{"w", "rad", "micro-rotation about e_3, counter-clockwise positive"},
        increment.micro_rotation);
  visit(FieldNotes{"k", "rad/m", "curvature, k_i = d w / d x_i", "1 2"}, increment.curvature);
}

}  // namespace polargrain
