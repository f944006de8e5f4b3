// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "common/cell.hpp"

namespace polargrain::dem {

/// The StateCheck of this project's cells (common/state_check.hpp): the checks of a state that need no
/// engine. Size, kind, number of grains, lengths and partners within it, finite numbers, box and places.
std::string state_fault(const CellDefinition& definition, const State& state);

}  // namespace polargrain::dem
