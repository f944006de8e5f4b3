// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>

#include "fem/solver/problem.hpp"

namespace polargrain::fem {

/// Ground under its own weight below a level surface; e_2 points up, in space e_3.
struct Ground {
  double surface_height = 0.0;      ///< of the surface, m
  double unit_weight = 0.0;         ///< N/m^3, positive
  double earth_pressure_ratio = 1;  ///< K0, horizontal over vertical stress
  double surcharge = 0.0;           ///< pressure on the surface, Pa
  /// Where pores are full of water at rest: the height of its level, m. Weight and surcharge are then total, the stress is effective,
  /// and K0 the ratio of effective stresses.
  std::optional<double> water_level = {};
  double water_weight = 0.0;  ///< N/m^3
};

/// Vertical stress -(surcharge + weight times depth), K0 times that across, no shear, no couples.
template <int dim = 2>
InitialStress<dim> geostatic_stress(const Ground& ground, std::string region = "");
/// Gravity, at its full value at all times unless a table says otherwise.
template <int dim = 2>
BodyLoad<dim> gravity(double unit_weight, TimeTable factor = TimeTable::constant(1.0),
                      std::string region = "");

}  // namespace polargrain::fem
