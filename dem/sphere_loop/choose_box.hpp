// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>

#include "common/cell.hpp"
#include "dem/sphere_loop/space_grain_box.hpp"
#include "dem/spheres/sphere_engine.hpp"

namespace polargrain::dem {

/// The box that steps the spheres of an engine that has been set up, with their contacts: the loop over spheres where it
/// knows the scene and `loop` allows it, else the engine's own. @param engine must outlive it
std::unique_ptr<SpaceGrainBox> choose_box(SphereEngine& engine, CellLoop loop);

}  // namespace polargrain::dem
