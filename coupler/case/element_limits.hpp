// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

namespace polargrain::coupler {

/// Why a built-in mesh cannot have so many elements; empty when it can. @param dimension 2 or 3
std::string too_many_elements(int dimension, double count);

}  // namespace polargrain::coupler
