// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "coupler/case/section.hpp"
#include "grains_io/script.hpp"

namespace polargrain::coupler {

/// The part of the case that readers of materials need: where files are looked for, which scripts it may name, its continuum.
struct CaseFiles {
  std::filesystem::path directory;  ///< of the case file
  ScriptRules scripts = {};
  int dem_steps = 0;  ///< of an explicit step; 0: cells are asked by Newton's method
  bool iterates =
      true;  ///< whether steps are balanced by iterations; with dem_steps too where the method is automatic
  int ask_every = 0;           ///< explicit steps after which cells of a law follow; 0: as dem_steps
  int dimension = 2;           ///< of the elements, 2 or 3
  bool cosserat = true;        ///< false: a classical continuum, which asks for no Gc and no lc
  bool spreads_slips = false;  ///< laws take their slip from the nodes (Case::spread)
  bool one_point = false;  ///< some elements have one point, which does not see all patterns of their nodes
};

/// The text of a script with the included files in their place (paths from the including file), marked with the origin of each
/// part (kScriptMark); unchanged without an include. An include that cannot be read is left as it stands.
std::string text_of_script(const std::filesystem::path& file);

/// A script and the files that it includes.
std::vector<std::filesystem::path> files_of_script(const std::filesystem::path& file);

/// A script of cells as a case or a specification names it.
struct CellScript {
  std::string file;  ///< as found; empty, with faults, when no script may be used
  std::string text;
};

/// Finds, reads and checks the script that `key` names (docs/running.md: who is trusted with what). It must lie in the
/// folder of the case or below liggghts_inputs/, so must all that it includes, unless the command line names it (--set)
/// or scripts are trusted; its commands are checked by script_faults.
CellScript read_cell_script(const std::string& key, Section& section, Faults& faults, const CaseFiles& files);

}  // namespace polargrain::coupler
