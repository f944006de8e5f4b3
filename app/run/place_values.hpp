// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "coupler/case/place_values.hpp"
#include "fem/mesh/find_place.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::app {

/// Values at a place of the body, in the order asked for; NaN outside of what is there. @param finder of its mesh @param at m, on the mesh as it was made
template <int dim>
std::vector<double> values_at(const fem::Solver<dim>& solver, const fem::PlaceFinder<dim>& finder,
                              const std::vector<double>& at, const std::vector<coupler::PlaceValue>& values);

/// Writes a profile of the committed state as a table: distance, place and values, a row a point; where the line passes an
/// interface, or stresses the border of two materials, a row a side. @param regions of the case: region to material
/// @throws RunError when it cannot be written
template <int dim>
void write_profile(const std::filesystem::path& file, const coupler::Profile& profile,
                   const fem::Solver<dim>& solver, const std::map<std::string, std::string>& regions);

}  // namespace polargrain::app
