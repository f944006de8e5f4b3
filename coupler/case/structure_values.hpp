// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "fem/solver/problem.hpp"

namespace polargrain::coupler {

/// The values that a monitor may read. Of an interface: pressure (resultant of the normal stress, positive when it pushes), shear
/// (resultant; in space its magnitude), lever (height of the resultant pressure above the lowest point), slip, gap and
/// mobilised (the largest of all points). Of a beam: moment, axial, shear, each the one of the largest magnitude. Of an anchor:
/// force. @param kind "interface", "beam", "anchor"
const std::vector<std::string>& values_of_structure(const std::string& kind);

/// Names of all structures of a kind.
template <int dim>
std::vector<std::string> structures_of(const fem::Problem<dim>& problem, const std::string& kind);

/// A committed value, in SI units. @throws RunError when it has no such value
template <int dim>
double value_of_structure(const fem::Problem<dim>& problem, const std::string& structure,
                          const std::string& value);

}  // namespace polargrain::coupler
