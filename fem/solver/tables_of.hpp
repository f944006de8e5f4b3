// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "fem/solver/problem.hpp"

namespace polargrain::fem {

/// All that changes with the loading time from outside: movements, pressures, tractions, forces, weights. As long as the
/// problem lives.
template <int dim>
std::vector<const TimeTable*> tables_of(const Problem<dim>& problem) {
  std::vector<const TimeTable*> tables;
  for (const auto& item : problem.prescribed) tables.push_back(&item.value);
  for (const auto& load : problem.boundary_loads) {
    tables.push_back(&load.pressure);
    for (const TimeTable& along : load.traction) tables.push_back(&along);
    for (const TimeTable& about : load.couple_traction) tables.push_back(&about);
  }
  for (const auto& load : problem.node_loads) tables.push_back(&load.value);
  for (const auto& load : problem.body_loads) tables.push_back(&load.factor);
  return tables;
}

}  // namespace polargrain::fem
