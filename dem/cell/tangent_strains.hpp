// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>

#include "common/increment.hpp"

namespace polargrain::dem {

// The unit strains of a tangent, one a column, and the tangent that their stresses make.

/// The symmetric unit strains: e_ii, then e_ij + e_ji of the shears 12, 13, 23.
template <int dim>
struct Symmetric {
  static constexpr int count = dim * (dim + 1) / 2;
  using Columns = Eigen::Matrix<double, Cosserat<dim>::components, count>;
  /// Components ij and ji of strain k.
  static constexpr std::array<int, 2> places(int k) {
    constexpr std::array<std::array<int, 2>, 3> shears{{{0, 1}, {0, 2}, {1, 2}}};
    const auto [i, j] = k < dim ? std::array{k, k} : shears[static_cast<std::size_t>(k - dim)];
    return {Cosserat<dim>::stress_place(i, j), Cosserat<dim>::stress_place(j, i)};
  }
};

template <int dim>
typename Symmetric<dim>::Columns classical_strains() {
  typename Symmetric<dim>::Columns strains = Symmetric<dim>::Columns::Zero();
  for (int k = 0; k < Symmetric<dim>::count; ++k)
    for (const int place : Symmetric<dim>::places(k)) strains(place, k) += 0.5;
  return strains;
}

/// Symmetrised in shear, and without couple stresses.
template <int dim>
typename Cosserat<dim>::Matrix classical_tangent(const typename Symmetric<dim>::Columns& stresses) {
  typename Cosserat<dim>::Matrix tangent = Cosserat<dim>::Matrix::Zero();
  for (int k = 0; k < Symmetric<dim>::count; ++k)
    for (const int place : Symmetric<dim>::places(k)) tangent.col(place) = stresses.col(k);
  for (int k = dim; k < Symmetric<dim>::count; ++k) {
    const auto [one, other] = Symmetric<dim>::places(k);
    const Eigen::RowVector<double, Cosserat<dim>::components> shear =
        0.5 * (tangent.row(one) + tangent.row(other));
    tangent.row(one) = tangent.row(other) = shear;
  }
  tangent.template bottomRows<Cosserat<dim>::couples>().setZero();
  return tangent;
}

/// All unit strains of the plane but e33.
using CosseratStrains = Eigen::Matrix<double, 7, 6>;
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
