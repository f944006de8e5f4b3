// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <span>

#include "common/state.hpp"

namespace polargrain::coupler::mgis {

// The state of a cell as internal variables of a host. They are whole numbers below 2^48, six bytes of the state in each,
// so that a host may write them into any file, copy them, and look for NaN among them. All zero: the
// packing at rest, with which hosts begin.

/// How many doubles hold a state of so many bytes.
std::size_t doubles_for(std::size_t bytes);

/// @param values takes the state, the rest is zero @throws RunError when it is too short
void pack_state(const State& state, std::span<double> values);

/// The state; null for the packing at rest. @throws RunError when the values are not from pack_state
StatePointer unpack_state(std::span<const double> values);

}  // namespace polargrain::coupler::mgis
