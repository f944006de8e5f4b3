// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/left_out.hpp"

#include <fmt/format.h>

#include <cmath>

#include "fem/material/polar_decomposition.hpp"

namespace polargrain::fem {
namespace {

constexpr double kRotation = 0.05;  ///< rad; stresses are then wrong by as much of their principal difference
constexpr double kStrain = 0.1;     ///< lengths, areas and forces per length are wrong by as much

}  // namespace

template <int dim>
std::string left_out_by_small_deformation(const Discretisation<dim>& discretisation,
                                          const Eigen::VectorXd& displacement,
                                          const std::vector<typename Cosserat<dim>::Gradient>& placed_with) {
  const std::vector<Increment<dim>> all = discretisation.increments(displacement);
  double rotation = 0.0;
  double strain = 0.0;
  std::size_t turned = 0;
  std::size_t strained = 0;
  for (std::size_t point = 0; point < all.size(); ++point) {
    typename Cosserat<dim>::Gradient h = all[point].displacement_gradient;
    if (!placed_with.empty()) h -= placed_with[point];
    double turn = 0.0;
    if constexpr (dim == 2) {
      turn = 0.5 * std::abs(h(1, 0) - h(0, 1));
    } else {
      turn = axial(h).norm();
    }
    const double stretch = (0.5 * (h + h.transpose())).norm();
    if (turn > rotation) rotation = turn, turned = point;
    if (stretch > strain) strain = stretch, strained = point;
  }
  if (rotation <= kRotation && strain <= kStrain) return {};
  return fmt::format(
      "small deformation leaves out that element {} has turned by {:.2g} rad and element {} has been strained by "
      "{:.2g}: stresses are off by up to {:.0f} % of the difference of the principal stresses, lengths by up to "
      "{:.0f} %, and more from here on; 'deformation: large' takes both in",
      discretisation.element_of_point(turned), rotation, discretisation.element_of_point(strained), strain,
      100.0 * rotation, 100.0 * strain);
}

template std::string left_out_by_small_deformation<2>(const Discretisation<2>& discretisation,
                                                      const Eigen::VectorXd& displacement,
                                                      const std::vector<Cosserat<2>::Gradient>& placed_with);
template std::string left_out_by_small_deformation<3>(const Discretisation<3>& discretisation,
                                                      const Eigen::VectorXd& displacement,
                                                      const std::vector<Cosserat<3>::Gradient>& placed_with);

}  // namespace polargrain::fem
