// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "coupler/case/parts.hpp"

namespace polargrain::coupler {

/// Whether `spread` is `measured` or so many d50, and no length.
bool spread_is_of_grains(const Entry& spread);

/// Such a spread, m. There is one in a body, so all materials with grains must have it: the file that polargrain layer has written
/// beside their packings, or grains of one size. With a fault: any length, to read on with.
/// @param document of the whole case, whose materials are not read yet
double spread_of_grains(const Entry& spread, const Entry& document, CaseParts& parts);

}  // namespace polargrain::coupler
