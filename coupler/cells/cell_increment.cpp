// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/cell_increment.hpp"

namespace polargrain::coupler {

bool is_zero(const Increment<2>& increment) {
  return increment.displacement_gradient.isZero(0.0) && increment.micro_rotation == 0.0 &&
         increment.curvature.isZero(0.0);
}

Increment<2> increment_for_cell(const Increment<2>& of_point) {
  if (of_point.configuration == Configuration::start) return of_point;
  const Eigen::Matrix2d& h = of_point.displacement_gradient;
  const double rotation = 0.5 * (h(1, 0) - h(0, 1));
  Increment<2> straight = of_point;
  straight.displacement_gradient = 0.5 * (h + h.transpose());
  straight.micro_rotation -= rotation;
  return straight;
}

Increment<2> increment_for_free_cell(const Increment<2>& of_point) {
  Increment<2> felt;
  felt.displacement_gradient = increment_for_cell(of_point).displacement_gradient;
  felt.configuration = of_point.configuration;
  return felt;
}

}  // namespace polargrain::coupler
