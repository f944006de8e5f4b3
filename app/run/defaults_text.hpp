// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "coupler/case/section.hpp"

namespace polargrain::app {

/// "not given in steps: cut 6, iterations 30", a line each section: a later version may have other defaults.
std::vector<std::string> lines_of_defaults(std::span<const coupler::KeyLeft> left);

}  // namespace polargrain::app
