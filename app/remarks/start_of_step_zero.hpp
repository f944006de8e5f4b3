// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>

#include "app/remarks/scene.hpp"

namespace polargrain::app {

/// The outcome of step 0 under loads and stress at time zero, were the body elastic (of laws: E and nu; of grains: the moduli
/// of their network at rest).
struct StartOfStepZero {
  double largest_displacement = 0.0;  ///< m
  double out_of_balance = 0.0;        ///< unbalanced forces over the forces of the loads and supports
  double stress_change =
      0.0;                  ///< root of the mean square over the body, over that of the stress at time zero
  bool has_stress = false;  ///< whether any stress is given at time zero
};

/// One linear solution on the mesh of the case; nothing for large meshes, where it would take longer than a check may, and
/// where a modulus is not known.
std::optional<StartOfStepZero> start_of_step_zero(const Scene& scene);

}  // namespace polargrain::app
