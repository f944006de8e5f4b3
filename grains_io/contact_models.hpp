// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "grains_io/script_words.hpp"

namespace polargrain {

/// The last `pair_style gran` of a script: model hooke, tangential history, damping on.
std::map<std::string, std::string> contact_models_of(const std::vector<ScriptWords>& script);

/// Names the springs of contacts, which states of cells hold: states fit each other where these texts are equal. Dashpots and
/// models that are off are left out; empty without a `pair_style gran`. @param text of the script
std::string springs_of_script(const std::string& text);

}  // namespace polargrain
