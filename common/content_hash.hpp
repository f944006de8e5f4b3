// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>

#include "common/state.hpp"

namespace polargrain {

/// The name (XXH3, 128 bits) of a file's content, however large: it is read piece by piece.
/// @throws RunError with the reason when it cannot be read
ContentName content_hash(const std::filesystem::path& file);

}  // namespace polargrain
