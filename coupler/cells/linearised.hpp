// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "common/increment.hpp"
#include "common/response.hpp"
#include "fem/material/polar_decomposition.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {

/// The increment with that displacement gradient, and no more.
template <int dim>
Increment<dim> increment_of(const Eigen::Matrix<double, dim, dim>& displacement_gradient) {
  Increment<dim> increment;
  increment.displacement_gradient = displacement_gradient;
  return increment;
}

/// An answer of a cell carried a little further on. In small deformation: s + C : e + (W s - s W), m + D : e + W m (in space W m - m W),
/// with e the Cosserat strain of the offset and W the skew part of its displacement gradient (docs/adaptivity.md, 1). In
/// large deformation: R (s + C : e) R^T, R (m + D : e) (in space R (m + D : e) R^T), with e the strain of the stretch of the offset and R its turn
/// (fem/material/rotation.hpp). Of cells with free rotations stress and tangent are to be symmetric.
Vector7 linearised_stress(const Response<2>& answer, const Increment<2>& offset);
Vector18 linearised_stress(const Response<3>& answer, const Increment<3>& offset);

/// The answer with its tangent in the axes of where the offset leads to; the stress stays as it is.
template <int dim>
Response<dim> with_tangent_turned(Response<dim> answer, const Increment<dim>& offset);

/// The rotation of an increment of large deformation.
inline double rotation_of(const Increment<2>& increment) {
  return fem::rotation_angle(increment);
}
inline Eigen::Matrix3d rotation_of(const Increment<3>& increment) {
  return fem::rotation_by(fem::rotation_vector(increment));
}

}  // namespace polargrain::coupler
