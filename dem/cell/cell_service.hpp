// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>

#include "common/cell.hpp"
#include "dem/engine/engine.hpp"  // start_engine_process

namespace polargrain::dem {

/// A LIGGGHTS engine that stands in for the cells of one definition (mechanics C.6, mode 1).
std::unique_ptr<CellService> make_cell_service(const CellDefinition& definition);

}  // namespace polargrain::dem
