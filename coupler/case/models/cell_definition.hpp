// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "common/cell.hpp"
#include "coupler/case/cell_script.hpp"
#include "coupler/case/section.hpp"
#include "coupler/cells/network_moduli.hpp"

namespace polargrain::coupler {

/// Reads what every model with cells asks for: script, packing and how the cells are loaded. Only fit for use
/// when no fault has been added.
CellDefinition read_cell_definition(const std::string& material, Section& section, Faults& faults,
                                    const CaseFiles& files);

/// Reads G, Gc (both `from packing` unless given) and lc.
CosseratChoice read_cosserat_choice(Section& section);

}  // namespace polargrain::coupler
