// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/state.hpp"
#include "dem/spheres/space_box.hpp"

namespace polargrain::dem {

/// The part of a box of spheres that changes from one step to the next, and nothing else: radii, masses and laws are those of
/// the packing and the script. Spheres are counted as in the packing.
struct SphereSnapshot {
  /// In the frame of the box; rotations in the laboratory.
  struct Motion {
    std::array<double, 3> place{}, velocity{}, spin{}, turned{};  ///< m, m/s, rad/s, rad
  };
  /// A contact with springs that are not zero.
  struct Springs {
    std::int32_t first = 0;
    std::int32_t second = 0;
    std::array<std::int32_t, 3> image{};  ///< in which the first sphere sees the second
    std::int32_t unused = 0;
  };

  SpaceBox box;
  int code = 0;     ///< DiscCombination::code: under which laws the springs mean something
  int springs = 0;  ///< values a contact
  std::vector<Motion> spheres;
  std::vector<Springs> contacts;  ///< by ascending `first`
  std::vector<double> values;     ///< `springs` a contact, as SphereSpring counts them
};

/// Whether a state is one of this kind; states of the engine's general loop are not.
bool is_sphere_state(const State& state);

StatePointer encode(const SphereSnapshot& snapshot);

/// Checks all bytes: lengths, numbers of spheres, finite values.
/// @throws RunError with the fault
SphereSnapshot decode_spheres(const State& state);

/// The fault of the box and the spheres of a snapshot; empty when they are sound.
/// @param radii of the spheres, as many as there are, m @param time_step s; 0: not known
std::string snapshot_fault(const SphereSnapshot& snapshot, const std::vector<double>& radii,
                           double time_step);

}  // namespace polargrain::dem
