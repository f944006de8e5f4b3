// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

namespace polargrain::app {

/// @param option that gave the seeds
/// @throws InputError where a seed stands twice: one seed makes the same grains again, which are no further sample
void check_independent_seeds(std::vector<int> seeds, const std::string& option);

}  // namespace polargrain::app
