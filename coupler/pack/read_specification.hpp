// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "common/packing_specification.hpp"

namespace polargrain::coupler {

/// Reads what `polargrain pack` is asked for (docs/user_guide.md), its script included.
/// @param settings KEY=VALUE that replace values of the file
/// @throws InputError with all faults
PackingSpecification read_packing_specification(const std::filesystem::path& file,
                                                const std::vector<std::string>& settings);

}  // namespace polargrain::coupler
