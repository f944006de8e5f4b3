// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <vector>

#include "common/state.hpp"
#include "dem/box/box.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace polargrain::dem {

/// Takes everything the engine needs to go on: the box, and each grain with its velocity, spin and contact
/// history, as the engine packs a grain that leaves for another process. Bits survive.
/// @param rotations of the grains so far, rad: one a disc, three a sphere (FixCellStrain), or empty
template <int dim>
StatePointer save_state(LAMMPS_NS::LAMMPS& lammps, const Box<dim>& box,
                        std::span<const double> rotations = {});

template <int dim>
struct RestoredState {
  Box<dim> box;
  std::vector<double> rotations;  ///< rad, one a disc, three a sphere; zero when not in the state
};

/// Puts a state into the engine in place of its present one; the grains keep the masses they have in the
/// engine, which are the packing's. Forces and neighbour lists are not set up yet.
/// @throws RunError when the bytes are not a state of this engine: nothing of them is believed
/// (packed_grains.hpp, snapshot.hpp), because the engine believes every length and partner.
template <int dim>
RestoredState<dim> restore_state(LAMMPS_NS::LAMMPS& lammps, const State& state);

/// Whether the engine's script and packing have the layout of a state that was saved with save_state: as many
/// grains, as many values a contact.
bool state_fits(LAMMPS_NS::LAMMPS& lammps, const State& state);

}  // namespace polargrain::dem
