// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "common/packing.hpp"

namespace polargrain {

/// A packing as the text of a LIGGGHTS data file (read_data, atom_style granular): the box with its tilt, the
/// first base vector along x, one atom type, and for each grain the density that gives the engine's sphere
/// the grain's own mass. Grain ids are counted from 1, as the engine wants them. A packing in space has a
/// right box from 0 on, periodic in all directions. What lies ready in contacts (Packing::state) is not part
/// of it.
std::string packing_data(const Packing& packing);

}  // namespace polargrain
