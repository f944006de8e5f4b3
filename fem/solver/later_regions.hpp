// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "fem/solver/problem.hpp"

namespace polargrain::fem {

/// Whether a region is placed by a later stage: nothing of it is there at the start.
template <int dim>
bool comes_later(const Problem<dim>& problem, const std::string& region) {
  const auto life = problem.lifetimes.find(region);
  return life != problem.lifetimes.end() && life->second.begin > 0;
}

}  // namespace polargrain::fem
