// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "common/increment.hpp"
#include "common/response.hpp"

namespace polargrain::coupler {

/// The increment with that displacement gradient, and no more.
Increment<2> increment_of(const Eigen::Matrix2d& displacement_gradient);

/// An answer of a cell carried a little further on. In small deformation: s + C : e + (W s - s W), m + D : e + W m,
/// with e the Cosserat strain of the offset and W the skew part of its displacement gradient (docs/adaptivity.md, 1). In
/// large deformation: R (s + C : e) R^T, R (m + D : e), with e the strain of the stretch of the offset and R its turn
/// (fem/material/rotation.hpp). Of cells with free rotations stress and tangent are to be symmetric.
Vector7 linearised_stress(const Response<2>& answer, const Increment<2>& offset);

/// The answer with its tangent in the axes of where the offset leads to; the stress stays as it is.
Response<2> with_tangent_turned(Response<2> answer, const Increment<2>& offset);

}  // namespace polargrain::coupler
