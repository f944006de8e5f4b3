// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/hosts/definition_of_words.hpp"

#include <fmt/format.h>

#include "common/plain_text.hpp"
#include "coupler/case/models/cell_definition.hpp"
#include "coupler/case/script_scene.hpp"

namespace polargrain::coupler {

CellDefinition read_hosted_cell(Section& section, Faults& faults, const CaseFiles& files,
                                const std::optional<Packing>& packing) {
  CellDefinition definition;
  if (packing) {
    definition = read_cell_without_packing("cell", section, faults, files);
    definition.packing = *packing;
    const std::vector<Fault> other =
        scene_faults(definition.script, definition.script_file, packing->dimension);
    faults.insert(faults.end(), other.begin(), other.end());
  } else {
    definition = read_cell_definition("cell", section, faults, files);
  }
  read_controlled(section, definition);
  return definition;
}

CellDefinition definition_of(const CellWords& cell) {
  Entry document;
  document.kind = Entry::Kind::map;
  document.file = cell.source;
  for (const auto& [key, text] : cell.words) {
    // The system would read the name of a file to its first NUL.
    if (const std::string character = control_character_in(key + text); !character.empty())
      throw InputError(
          {cell.source, 0,
           fmt::format("{}: holds the control character {}; remove it", plain_text(key), character)});
    Entry value;
    value.kind = Entry::Kind::scalar;
    value.text = text;
    value.file = cell.source;
    document.members.push_back({key, 0, std::move(value)});
  }
  Faults faults;
  Section section(document, "cell", faults);
  CellDefinition definition = read_hosted_cell(section, faults, {cell.directory, cell.scripts}, cell.packing);
  section.finish();
  if (!faults.empty()) throw InputError(faults);
  return definition;
}

}  // namespace polargrain::coupler
