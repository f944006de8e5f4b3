// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "coupler/case/case.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::coupler {

/// The values that a monitor may read at boundaries and node sets: pressure (Pa, mean over the nodes), outflow (m^3 that
/// has left there since the start; in the plane m^2 per m of thickness), flow (the same a second, mean over the last step).
const std::vector<std::string>& values_of_water();

/// Whether some of those nodes carry a pore pressure.
bool has_water_at(const Case& the_case, const std::vector<std::string>& on);

/// A committed value, in SI units. @throws RunError where the problem has no water
template <int dim>
double value_of_water(const fem::Solver<dim>& solver, const std::vector<std::string>& on,
                      const std::string& value);

}  // namespace polargrain::coupler
