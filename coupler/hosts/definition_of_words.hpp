// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/cell.hpp"
#include "coupler/case/cell_script.hpp"
#include "grains_io/script.hpp"

namespace polargrain::coupler {

/// A cell as a host names it, which has no case: the keys that a material of `model: cell` has for it, with their values
/// as a case would write them.
struct CellWords {
  std::string source;  ///< where the words stand, for messages: a file; empty: in the arguments of a call
  std::vector<std::pair<std::string, std::string>> words;
  std::optional<Packing> packing = {};   ///< in place of the key `packing`
  std::filesystem::path directory = {};  ///< where files are looked for first
  ScriptRules scripts = {};
};

/// The same from a map that may hold other keys too; the caller finishes the section. Fit for use when there are no faults.
CellDefinition read_hosted_cell(Section& section, Faults& faults, const CaseFiles& files,
                                const std::optional<Packing>& packing = {});

/// Reads and checks the cell: script, packing, rotations and how it is loaded.
/// @throws InputError with all faults, among them a key that cells do not have
CellDefinition definition_of(const CellWords& cell);

}  // namespace polargrain::coupler
