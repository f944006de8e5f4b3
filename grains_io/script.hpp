// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <set>
#include <string>
#include <vector>

#include "common/error.hpp"

namespace polargrain {

/// One command of a LIGGGHTS input script, continuation lines (&) joined.
struct ScriptCommand {
  std::string file;  ///< where it stands, for messages
  int line = 0;      ///< its last line
  std::string text;
};

/// A line of this form in a script, `#@ FILE:LINE`, says where the lines behind it come from.
inline constexpr const char* kScriptMark = "#@ ";

/// The commands of a script in their order; neither comments nor empty lines. @param file the user's name of it
std::vector<ScriptCommand> commands_of_script(const std::string& text, const std::string& file);

/// Which scripts of cells are run. A script is a program: LIGGGHTS's own language starts other programs, reads and writes
/// any file.
struct ScriptRules {
  bool trusted = false;  ///< any script (--trust-scripts)
  /// The commands and styles that the engine at hand has beside those of LIGGGHTS and that can do no harm.
  std::set<std::string> more_commands = {};
};

/// Commands of a script beyond setting up a cell (a contact law, its parameters, neighbours, groups, variables). Whatever
/// starts programs, reads or writes files, jumps about, or cannot be judged before it runs (a variable in the place of a
/// command) is found, also inside `if`. Texts that are not a script are not repeated. With trusted scripts: only that it is
/// not a script at all.
/// @param text with all that it includes in it (coupler/case/cell_script.hpp) @param file the user's name of it
/// @returns one fault a command, with file and line
std::vector<Fault> script_faults(const std::string& text, const std::string& file, const ScriptRules& rules);

}  // namespace polargrain
