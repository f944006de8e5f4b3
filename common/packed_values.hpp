// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/response.hpp"

namespace polargrain {

/// Lists of values of fixed length as one array of an archive, one after the other.

/// @throws RunError when the archive does not hold `count` lists of `length` values under that name
std::vector<double> read_lists(ArchiveReader& archive, const std::string& name, std::size_t count,
                               std::size_t length);

/// Stress, tangent, quality, step factor and noise of committed answers. The message is left out: what is
/// committed is good and has none.
void write_responses(ArchiveWriter& archive, const std::string& name, std::span<const Response> responses);
/// @throws RunError when the archive does not hold `count` of them
std::vector<Response> read_responses(ArchiveReader& archive, const std::string& name, std::size_t count);

}  // namespace polargrain
