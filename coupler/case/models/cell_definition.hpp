// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>

#include "common/cell.hpp"
#include "coupler/case/cell_script.hpp"
#include "coupler/case/section.hpp"
#include "coupler/cells/network_moduli.hpp"

namespace polargrain::coupler {

/// Reads the keys common to all models with cells: script, packing and how the cells are loaded. Only fit for use
/// when no fault has been added.
CellDefinition read_cell_definition(const std::string& material, Section& section, Faults& faults,
                                    const CaseFiles& files, const CellControl& defaults = {});

/// The same but the packing, which the section is not asked for.
CellDefinition read_cell_without_packing(const std::string& name, Section& section, Faults& faults,
                                         const CaseFiles& files, const CellControl& defaults = {});

/// Reads `rotations` into the definition. @returns whether they are controlled
bool read_controlled(Section& section, CellDefinition& definition);

/// Reads `rotations` into the definition. With free rotations also G, Gc (both `from packing` unless given) and lc, which a
/// classical continuum does not ask for;
/// with controlled ones the grains answer for all of it, nothing is returned, and these keys are faults.
std::optional<CosseratChoice> read_rotations(Section& section, CellDefinition& definition,
                                             const CaseFiles& files);

}  // namespace polargrain::coupler
