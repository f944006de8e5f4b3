// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>

#include "coupler/case/section.hpp"
#include "grains_io/script.hpp"

namespace polargrain::coupler {

/// What the reader of a material needs of the case: where files are looked for, which scripts it may name, its continuum.
struct CaseFiles {
  std::filesystem::path directory;  ///< of the case file
  ScriptRules scripts = {};
  bool cosserat = true;  ///< false: a classical continuum, which asks for no Gc and no lc
};

/// The text of a script with what it includes in its place (paths from the including file), marked with where each part
/// comes from (kScriptMark); one that includes nothing as it is. What cannot be included is left as it stands.
std::string text_of_script(const std::filesystem::path& file);

/// A script of cells as a case or a specification names it.
struct CellScript {
  std::string file;  ///< as found; empty, with faults, when there is none that may be used
  std::string text;
};

/// Finds, reads and checks the script that `key` names (docs/running.md: who is trusted with what). It must lie in the
/// folder of the case or below liggghts_inputs/, so must all that it includes, unless the command line names it (--set)
/// or scripts are trusted; its commands are checked by script_faults.
CellScript read_cell_script(const std::string& key, Section& section, Faults& faults, const CaseFiles& files);

}  // namespace polargrain::coupler
