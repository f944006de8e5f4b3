// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "common/archive.hpp"

namespace polargrain {

/// Lists of values of fixed length as one array of an archive, one after the other.

/// @throws RunError when the archive does not hold `count` lists of `length` values under that name
std::vector<double> read_lists(ArchiveReader& archive, const std::string& name, std::size_t count,
                               std::size_t length);

}  // namespace polargrain
