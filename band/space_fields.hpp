// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>

#include "band/shear_plane.hpp"

namespace polargrain::band {

/// Whether a field file of `polargrain run` is of a body in space. @throws InputError when it is another kind of file
bool is_of_space(const std::filesystem::path& file);

/// The change between two field files of one body in space, at the integration points of its elements.
/// @param current places stand where they are at `from`, not where they stood at the start
/// @throws InputError naming the file when it is another kind of .vtu, or the meshes differ
SpaceSamples space_increment(const std::filesystem::path& from, const std::filesystem::path& to,
                             bool current);

}  // namespace polargrain::band
