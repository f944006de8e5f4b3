// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/lent_stress.hpp"

#include <Eigen/Eigenvalues>

#include "common/increment.hpp"

namespace polargrain::coupler {
namespace {

Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(const Vector18& stress) {
  Eigen::Matrix3d symmetric;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      symmetric(i, j) =
          0.5 * (stress(Cosserat<3>::stress_place(i, j)) + stress(Cosserat<3>::stress_place(j, i)));
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric);
}

}  // namespace

template <int dim>
typename Cosserat<dim>::Vector with_lent_stress(const typename Cosserat<dim>::Vector& cell,
                                                const typename Cosserat<dim>::Vector& law) {
  typename Cosserat<dim>::Vector lent = cell;
  if constexpr (dim == 2) {
    const double law_in_plane = law(k11) + law(k22);
    if (law_in_plane < 0.0) lent(k33) = law(k33) / law_in_plane * (cell(k11) + cell(k22));
  } else {
    const auto of_law = principal(law);
    const double law_ends = of_law.eigenvalues()(0) + of_law.eigenvalues()(2);
    if (!(law_ends < 0.0)) return cell;
    const auto of_cell = principal(cell);
    const Eigen::Vector3d& stresses = of_cell.eigenvalues();
    const double change = of_law.eigenvalues()(1) / law_ends * (stresses(0) + stresses(2)) - stresses(1);
    const Eigen::Vector3d axis = of_cell.eigenvectors().col(1);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) lent(Cosserat<3>::stress_place(i, j)) += change * axis(i) * axis(j);
  }
  return lent;
}

template Vector7 with_lent_stress<2>(const Vector7&, const Vector7&);
template Vector18 with_lent_stress<3>(const Vector18&, const Vector18&);

}  // namespace polargrain::coupler
