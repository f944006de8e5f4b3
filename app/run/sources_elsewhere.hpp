// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>

#include "app/run/run.hpp"
#include "coupler/case/case.hpp"

namespace polargrain::app {

/// Refuses a result directory in which the run would erase what it is read from: the run that it starts from, and files
/// that its case names. @throws InputError
void check_sources_are_elsewhere(const RunOptions& options, const coupler::Case& the_case,
                                 const std::filesystem::path& directory);

}  // namespace polargrain::app
