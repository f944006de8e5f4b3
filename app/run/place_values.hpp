// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <vector>

#include "coupler/case/place_values.hpp"
#include "fem/mesh/find_place.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::app {

/// Values at a place of the body, in the order asked for; NaN outside of what is there. @param finder of its mesh @param at m, on the mesh as it was made
template <int dim>
std::vector<double> values_at(const fem::Solver<dim>& solver, const fem::PlaceFinder<dim>& finder,
                              const std::vector<double>& at, const std::vector<coupler::PlaceValue>& values);

/// Writes a profile of the committed state as a table: distance, place and values, a row a point.
/// @throws RunError when it cannot be written
template <int dim>
void write_profile(const std::filesystem::path& file, const coupler::Profile& profile,
                   const fem::Solver<dim>& solver);

}  // namespace polargrain::app
