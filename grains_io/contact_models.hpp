// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "grains_io/script_words.hpp"

namespace polargrain {

/// The last `pair_style gran` of a script: model hooke, tangential history, damping on.
std::map<std::string, std::string> contact_models_of(const std::vector<ScriptWords>& script);

/// What it says of the springs of contacts, which states of cells hold: equal texts, states that fit each other. Neither dashpots
/// nor what is off; empty without a `pair_style gran`. @param text of the script
std::string springs_of_script(const std::string& text);

}  // namespace polargrain
