// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "common/error.hpp"

namespace polargrain::coupler {

/// The faults of a script that sets up another scene than a cell of the packing has: another dimension, other units than SI, a
/// box that is not periodic; each at its line. Words that are not known before it runs are no fault.
/// @param text of the script @param file the user's name of it @param dimension of the packing, 2 or 3
std::vector<Fault> scene_faults(const std::string& text, const std::string& file, int dimension);

}  // namespace polargrain::coupler
