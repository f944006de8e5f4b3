// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "coupler/case/case.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::app {

/// Names and values of a committed step: built_in_values() first, then the monitors in the order of the case.
/// Reactions in N per m of thickness (rotations: N), displacements in m (rotations: rad), works in J per m.
using MonitorValues = std::vector<std::pair<std::string, double>>;

template <int dim>
MonitorValues monitor_values(const std::vector<coupler::Monitor>& monitors, const fem::Solver<dim>& solver);

/// The value of that name, which must be there.
double value_of(const MonitorValues& values, const std::string& name);

}  // namespace polargrain::app
