// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "fem/material/piecewise_linear.hpp"

namespace polargrain::fem {

/// What the Kozeny-Carman equation needs to know of a packing and of the water in it.
struct KozenyCarman {
  /// m; of equal spheres with the same surface per volume, 1 / sum(mass shares / diameters). Irregular grains: divided by 1.1 to 1.4.
  double diameter = 0.0;
  double viscosity = 1.0e-3;  ///< of water, Pa s; at 20 C
  double factor = 180.0;      ///< 36 times 5 for spheres
};

/// Hydraulic conductivity k (m/s) by the void ratio e. Laminar flow; an estimate by grains is good to a factor of 2 or 3.
class Permeability {
 public:
  /// @param k m/s
  static Permeability constant(double k) { return Permeability(PiecewiseLinear(k), {}); }
  /// k = (unit_weight / viscosity) d^2 e^3 / (factor (1 + e)). @param unit_weight of water, N/m^3
  static Permeability kozeny_carman(const KozenyCarman& grains, double unit_weight);
  /// @param k_of_e m/s over the void ratio (PiecewiseLinear::Knot::gamma_p): straight between its knots
  static Permeability table(PiecewiseLinear k_of_e) { return Permeability(std::move(k_of_e), {}); }

  [[nodiscard]] double at(double void_ratio) const;
  /// Whether it depends on the void ratio.
  [[nodiscard]] bool varies() const { return scale_ > 0.0 || table_.knots().size() > 1; }

 private:
  Permeability(PiecewiseLinear table, double scale) : table_(std::move(table)), scale_(scale) {}

  PiecewiseLinear table_;
  double scale_;  ///< of e^3 / (1 + e), m/s; 0: the table holds
};

}  // namespace polargrain::fem
