// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/increment.hpp"

namespace polargrain::coupler {

/// The micro-rotation of an increment, whatever its dimension: a number in the plane, a vector in space, rad.
inline double& micro_rotation(Increment<2>& increment) {
  return increment.micro_rotation;
}
inline double micro_rotation(const Increment<2>& increment) {
  return increment.micro_rotation;
}
inline Eigen::Vector3d& micro_rotation(Increment<3>& increment) {
  return increment.rotation;
}
inline const Eigen::Vector3d& micro_rotation(const Increment<3>& increment) {
  return increment.rotation;
}

/// The members of an increment that archives keep: all but the configuration, which the next step has again.
inline Increment<2>& kept_of(Increment<2>& increment) {
  return increment;
}
inline const Increment<2>& kept_of(const Increment<2>& increment) {
  return increment;
}
inline CellIncrement& kept_of(Increment<3>& increment) {
  return increment;
}
inline const CellIncrement& kept_of(const Increment<3>& increment) {
  return increment;
}

/// Whether nothing happens to the grains of a cell over the increment.
bool is_zero(const Increment<2>& increment);
bool is_zero(const Increment<3>& increment);

/// The increment that the cell of a point follows. In large deformation the increment as it is: the box turns, and its stress
/// with it. In small deformation no stress turns with the continuum, so the box
/// gets the symmetric part of the gradient, and its grains the micro-rotation against the rotation left out
/// (docs/theory/solver.md, small and large deformation).
template <int dim>
Increment<dim> increment_for_cell(const Increment<dim>& of_point);

/// The same for a cell whose grains turn as they like: they feel no micro-rotation and no curvature, which may go far where
/// nothing resists them.
template <int dim>
Increment<dim> increment_for_free_cell(const Increment<dim>& of_point);

}  // namespace polargrain::coupler
