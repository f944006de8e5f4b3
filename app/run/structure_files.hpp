// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>

#include "fem/solver/solver.hpp"

namespace polargrain::app {

/// Writes what the interfaces and beams of a committed step show: structures-NNNNN.csv and interfaces-NNNNN.vtu, in a
/// directory that is there (docs/file_formats.md). Nothing without them. @throws RunError when they cannot be written
template <int dim>
void write_structures(const std::filesystem::path& directory, int step, const fem::Solver<dim>& solver);

}  // namespace polargrain::app
