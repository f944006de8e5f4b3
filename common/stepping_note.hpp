// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string_view>

namespace polargrain {

/// Begins the line in which a cell says, beside other remarks on its packing at rest, which loop steps its grains. It is
/// news, not a warning.
inline constexpr std::string_view kSteppingNote = "grains are stepped by ";

}  // namespace polargrain
