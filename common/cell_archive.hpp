// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/cell.hpp"

namespace polargrain {

/// The last committed answers of cells, states included, under `name`. The seconds inside the engine are not
/// kept: they are no part of a result.
void write_cell_replies(ArchiveWriter& archive, const std::string& name, std::span<const CellReply> replies);
/// @throws RunError when the archive does not hold `count` of them
std::vector<CellReply> read_cell_replies(ArchiveReader& archive, const std::string& name, std::size_t count);

}  // namespace polargrain
