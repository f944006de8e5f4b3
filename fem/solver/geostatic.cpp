// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/geostatic.hpp"

#include <utility>

namespace polargrain::fem {

InitialStress geostatic_stress(const Ground& ground, std::string region) {
  const auto stress = [ground](const Eigen::Vector2d& x) {
    const double vertical = -(ground.surcharge + ground.unit_weight * (ground.surface_height - x(1)));
    Vector7 s = Vector7::Zero();
    s(k22) = vertical;
    s(k11) = s(k33) = ground.earth_pressure_ratio * vertical;
    return s;
  };
  return {stress, std::move(region)};
}

BodyLoad gravity(double unit_weight, TimeTable factor, std::string region) {
  return {[unit_weight](const Eigen::Vector2d&) { return Eigen::Vector3d(0.0, -unit_weight, 0.0); },
          std::move(factor), std::move(region)};
}

}  // namespace polargrain::fem
