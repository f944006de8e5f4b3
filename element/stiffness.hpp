// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "element/material_point.hpp"

namespace polargrain::element {

/// The displacement gradient of strains in the order of Place: nothing below the diagonal, so e_12 = d u_1 / d x_2.
inline Eigen::Matrix3d gradient_of(const Vector6& strain) {
  Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
  for (int place = 0; place < 6; ++place) {
    const auto [i, j] = kIndices[static_cast<std::size_t>(place)];
    h(i, j) = strain(place);
  }
  return h;
}

/// d (symmetric stress) / d (strains), both in the order of Place, Pa, without rotation. Column 3i + j of a cell's tangent is of
/// eps_ij: a gradient h_kl (k <= l) without rotation is half of two of them.
inline Matrix6 stiffness_of(const CellResponse& response) {
  Matrix6 result;
  for (int row = 0; row < 6; ++row) {
    const auto [i, j] = kIndices[static_cast<std::size_t>(row)];
    for (int column = 0; column < 6; ++column) {
      const auto [k, l] = kIndices[static_cast<std::size_t>(column)];
      const auto& c = response.tangent;
      result(row, column) = 0.25 * (c(3 * i + j, 3 * k + l) + c(3 * i + j, 3 * l + k) +
                                    c(3 * j + i, 3 * k + l) + c(3 * j + i, 3 * l + k));
    }
  }
  return result;
}

/// The increment of a cell over strains of a step: the grains turn with the continuum.
inline CellIncrement increment_over(const Eigen::Matrix3d& h) {
  CellIncrement increment;
  increment.displacement_gradient = h;
  increment.rotation << 0.5 * (h(2, 1) - h(1, 2)), 0.5 * (h(0, 2) - h(2, 0)), 0.5 * (h(1, 0) - h(0, 1));
  return increment;
}

}  // namespace polargrain::element
