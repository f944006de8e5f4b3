// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>

#include "dem/cell/cell_service.hpp"

namespace polargrain::dem {

/// The engine that stands in for the cells of spheres of a definition: make_cell_service makes it for a packing of
/// dimension 3. @throws RunError when the places of its grains are not a packing
std::unique_ptr<CellOfGrains> make_sphere_cell(const CellDefinition& definition);

}  // namespace polargrain::dem
