// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <vector>

#include "common/state.hpp"
#include "dem/cell/box.hpp"
#include "dem/cell/state_bounds.hpp"
#include "dem/discs/disc.hpp"

namespace polargrain::dem {

/// The part of a box of discs that changes from one step to the next, and nothing else: radii, masses and laws are those
/// of the packing and the script. Discs are counted as in the packing.
struct DiscSnapshot {
  using Motion = GrainMotion;
  /// A contact with springs that are not zero.
  struct Springs {
    std::int32_t first = 0;
    std::int32_t second = 0;
    LatticeVector image;  ///< in which the first disc sees the second
  };

  Box box;
  int code = 0;     ///< DiscCombination::code: under which laws the springs mean something
  int springs = 0;  ///< values a contact
  std::vector<Motion> discs;
  std::vector<Springs> contacts;  ///< by ascending `first`
  std::vector<double> values;     ///< `springs` a contact
};

/// Whether a state is one of this kind; states of the engine's general loop are not.
bool is_disc_state(const State& state);

StatePointer encode(const DiscSnapshot& snapshot);

/// Checks all bytes: lengths, numbers of discs, places, finite values.
/// @throws RunError with the fault
DiscSnapshot decode_discs(const State& state);

}  // namespace polargrain::dem
