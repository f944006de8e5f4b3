// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "app/run/run.hpp"
#include "coupler/case/case.hpp"
#include "coupler/checkpoint/checkpoint.hpp"

namespace polargrain::app {

/// The command that goes on with a run.
std::string resume_command(const RunOptions& options, const std::filesystem::path& directory);

/// Reads the checkpoint that a case may go on from.
/// @throws InputError when it cannot be used, or is of another case, with the differences
std::unique_ptr<coupler::Checkpoint> checkpoint_for(const coupler::Case& the_case,
                                                    const std::filesystem::path& file);

}  // namespace polargrain::app
