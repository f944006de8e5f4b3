// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/hosts/definition_of_words.hpp"

#include "coupler/case/models/cell_definition.hpp"

namespace polargrain::coupler {

CellDefinition definition_of(const CellWords& cell) {
  Entry document;
  document.kind = Entry::Kind::map;
  document.file = cell.source;
  for (const auto& [key, text] : cell.words) {
    Entry value;
    value.kind = Entry::Kind::scalar;
    value.text = text;
    value.file = cell.source;
    document.members.push_back({key, 0, std::move(value)});
  }
  Faults faults;
  Section section(document, "cell", faults);
  const CaseFiles files{cell.directory, cell.scripts};
  CellDefinition definition;
  if (cell.packing) {
    definition = read_cell_without_packing("cell", section, faults, files);
    definition.packing = *cell.packing;
  } else {
    definition = read_cell_definition("cell", section, faults, files);
  }
  read_controlled(section, definition);
  section.finish();
  if (!faults.empty()) throw InputError(faults);
  return definition;
}

}  // namespace polargrain::coupler
