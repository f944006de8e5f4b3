// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/state.hpp"
#include "dem/cell/box.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace polargrain::dem {

/// Takes everything the engine needs to go on: the box, and each grain with its velocity, spin and contact
/// history, as the engine packs a grain that leaves for another process. Bits survive.
StatePointer save_state(LAMMPS_NS::LAMMPS& lammps, const Box& box);

/// Puts a state into the engine in place of what is there, and returns its box. Forces and neighbour lists
/// are not set up yet.
/// @throws RunError when the bytes are not a state of this engine (another length, another number of history
/// values).
Box restore_state(LAMMPS_NS::LAMMPS& lammps, const State& state);

}  // namespace polargrain::dem
