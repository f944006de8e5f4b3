// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

namespace polargrain {

/// The words of one command of a script.
struct ScriptWords {
  std::string file;
  int line = 0;
  std::vector<std::string> words;  ///< at least one; variables that the script itself gives have their values
};

/// Of all commands, in their order. `neighbour_distance` stays a variable: the program gives it. @param file as commands_of_script
std::vector<ScriptWords> words_of_script(const std::string& text, const std::string& file);

}  // namespace polargrain
