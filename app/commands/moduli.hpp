// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "common/cell.hpp"

namespace polargrain::app {

/// What the contact network of each packing at rest resists with under its script (coupler/cells/network_moduli.hpp), in
/// words, as one worker that is started for it finds it. @param trust_scripts as the command was told
/// @throws RunError in the engine's words where a packing and its script do not fit
std::vector<std::string> moduli_of(std::span<const CellDefinition* const> cells, bool trust_scripts);

}  // namespace polargrain::app
