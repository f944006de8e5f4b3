// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "common/packing_specification.hpp"
#include "grains_io/script.hpp"

namespace polargrain::app {

/// Reads the specification of `polargrain pack` (docs/user_guide.md), its script included.
/// @param settings KEY=VALUE that replace values of the file
/// @throws InputError with all faults
PackingSpecification read_packing_specification(const std::filesystem::path& file,
                                                const std::vector<std::string>& settings,
                                                const ScriptRules& scripts = {});

/// Reads the specification for settling a packing under a script.
/// @param dimension of the packing @param pressure that it records, Pa; 0: not recorded @param text source of the packing, kept
/// with it
/// @param settings KEY=VALUE: pressure, pressure_tolerance, unbalanced_force_ratio, inertial_number, damping,
/// most_steps
/// @throws InputError with all faults
PackingSpecification read_settling(const std::filesystem::path& packing, const std::filesystem::path& script,
                                   int dimension, double pressure, const std::string& text,
                                   const std::vector<std::string>& settings, const ScriptRules& scripts = {});

}  // namespace polargrain::app
