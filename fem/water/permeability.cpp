// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/water/permeability.hpp"

namespace polargrain::fem {

Permeability Permeability::kozeny_carman(const KozenyCarman& grains, double unit_weight) {
  return {PiecewiseLinear(),
          unit_weight / grains.viscosity * grains.diameter * grains.diameter / grains.factor};
}

double Permeability::at(double void_ratio) const {
  if (scale_ > 0.0) return scale_ * void_ratio * void_ratio * void_ratio / (1.0 + void_ratio);
  return table_.at(void_ratio).value;
}

}  // namespace polargrain::fem
