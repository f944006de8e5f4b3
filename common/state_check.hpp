// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <string>

#include "common/cell.hpp"

namespace polargrain {

/// Why a state cannot be one of a cell; empty when it can be. Of a state whose bytes are elsewhere only the size
/// is judged. Whoever makes an engine gives one with it: others pass states on without knowing what they mean.
using StateCheck = std::function<std::string(const CellDefinition&, const State&)>;

}  // namespace polargrain
