// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <optional>

#include "common/error.hpp"

namespace polargrain::fem {

/// Gmsh's library puts all elements of an entity into each of its groups. Files of version 2 name groups element by element, and
/// other programs write the elements of several groups as one entity: with the library each of these groups has all of them.
/// @returns a fault for the first entity whose elements are not all in the same groups; nothing for files
/// without one, of another version, and binary ones
std::optional<Fault> entity_of_several_groups(const std::filesystem::path& file);

}  // namespace polargrain::fem
