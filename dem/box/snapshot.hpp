// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "common/state.hpp"
#include "dem/box/box.hpp"
#include "dem/box/state_bounds.hpp"

namespace polargrain::dem {

/// The part of a box of discs or of spheres, stepped by the loop over them, that changes from one step to the next, and
/// nothing else: radii, masses and laws are those of the packing and the script. Grains are counted as in the packing.
template <int dim>
struct Snapshot {
  /// A contact with springs that are not zero.
  struct Springs {
    std::int32_t first = 0;
    std::int32_t second = 0;
    /// In which the first grain sees the second, in base vectors; in space a zero fills up the bytes.
    std::array<std::int32_t, dim == 2 ? 2 : 4> image{};
  };

  Box<dim> box;
  int code = 0;     ///< LawCombination::code: under which laws the springs mean something
  int springs = 0;  ///< values a contact
  std::vector<GrainMotion<dim>> grains;
  std::vector<Springs> contacts;  ///< by ascending `first`
  std::vector<double> values;     ///< `springs` a contact
};

/// Whether a state is one of this kind; states of the engine's general loop are not.
template <int dim>
bool is_snapshot(const State& state);

template <int dim>
StatePointer encode(const Snapshot<dim>& snapshot);

/// Checks all bytes: lengths, numbers of grains, finite values.
/// @throws RunError with the fault
template <int dim>
Snapshot<dim> decode_snapshot(const State& state);

/// The fault of the box and the grains of a snapshot; empty when they are sound.
/// @param radii of the grains, as many as there are, m @param time_step s; 0: not known
template <int dim>
std::string snapshot_fault(const Snapshot<dim>& snapshot, const std::vector<double>& radii, double time_step);

}  // namespace polargrain::dem
