// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "common/increment.hpp"

namespace polargrain::dem {

// The unit strains of a tangent, one a column, and the tangent that their stresses make.

using ClassicalStrains = Eigen::Matrix<double, 7, 3>;
using CosseratStrains = Eigen::Matrix<double, 7, 6>;

/// The symmetric unit strains e11, e22 and e12 + e21.
inline ClassicalStrains classical_strains() {
  ClassicalStrains strains = ClassicalStrains::Zero();
  strains(k11, 0) = strains(k22, 1) = 1.0;
  strains(k12, 2) = strains(k21, 2) = 0.5;
  return strains;
}

inline Matrix7 classical_tangent(const ClassicalStrains& stresses) {
  Matrix7 tangent = Matrix7::Zero();
  tangent.col(k11) = stresses.col(0);
  tangent.col(k22) = stresses.col(1);
  tangent.col(k12) = tangent.col(k21) = stresses.col(2);
  const Eigen::RowVector<double, 7> shear = 0.5 * (tangent.row(k12) + tangent.row(k21));
  tangent.row(k12) = tangent.row(k21) = shear;
  tangent.bottomRows<2>().setZero();
  return tangent;
}

/// All unit strains but e33.
inline CosseratStrains cosserat_strains() {
  CosseratStrains strains = CosseratStrains::Zero();
  strains(k11, 0) = strains(k22, 1) = 1.0;
  strains.bottomRightCorner<4, 4>().setIdentity();
  return strains;
}

inline Matrix7 cosserat_tangent(const CosseratStrains& stresses) {
  Matrix7 tangent = Matrix7::Zero();
  tangent.leftCols<2>() = stresses.leftCols<2>();
  tangent.rightCols<4>() = stresses.rightCols<4>();
  return tangent;
}

}  // namespace polargrain::dem
