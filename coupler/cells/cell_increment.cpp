// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/cell_increment.hpp"

#include "fem/material/polar_decomposition.hpp"

namespace polargrain::coupler {

bool is_zero(const Increment<2>& increment) {
  return increment.displacement_gradient.isZero(0.0) && increment.micro_rotation == 0.0 &&
         increment.curvature.isZero(0.0);
}

bool is_zero(const Increment<3>& increment) {
  return increment.displacement_gradient.isZero(0.0) && increment.rotation.isZero(0.0) &&
         increment.curvature.isZero(0.0);
}

template <int dim>
Increment<dim> increment_for_cell(const Increment<dim>& of_point) {
  if (of_point.configuration == Configuration::start) return of_point;
  const auto& h = of_point.displacement_gradient;
  Increment<dim> straight = of_point;
  straight.displacement_gradient = 0.5 * (h + h.transpose());
  if constexpr (dim == 2) {
    straight.micro_rotation -= 0.5 * (h(1, 0) - h(0, 1));
  } else {
    straight.rotation -= fem::axial(h);
  }
  return straight;
}

template <int dim>
Increment<dim> increment_for_free_cell(const Increment<dim>& of_point) {
  Increment<dim> felt;
  felt.displacement_gradient = increment_for_cell(of_point).displacement_gradient;
  felt.configuration = of_point.configuration;
  return felt;
}

template Increment<2> increment_for_cell(const Increment<2>& of_point);
template Increment<3> increment_for_cell(const Increment<3>& of_point);
template Increment<2> increment_for_free_cell(const Increment<2>& of_point);
template Increment<3> increment_for_free_cell(const Increment<3>& of_point);

}  // namespace polargrain::coupler
