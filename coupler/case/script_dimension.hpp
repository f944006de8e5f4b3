// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "common/error.hpp"

namespace polargrain::coupler {

/// The fault of a script that sets up another dimension than the packing has: one fault at its line `dimension N`; empty
/// where they agree, or the script says it in words that are not known before it runs.
/// @param text of the script @param file the user's name of it @param dimension of the packing, 2 or 3
std::vector<Fault> dimension_faults(const std::string& text, const std::string& file, int dimension);

}  // namespace polargrain::coupler
