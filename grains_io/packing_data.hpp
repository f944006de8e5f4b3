// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "common/packing.hpp"

namespace polargrain {

/// The words that such a file begins with.
inline constexpr const char* kPackingDataHead = "packing of polargrain: ";

/// A packing as the text of a LIGGGHTS data file (read_data, atom_style granular): the box with its tilt, the
/// first base vector along x, one atom type, and for each grain the density that gives it its own mass in the
/// engine: mass over area in a plane packing, to be read with `dimension 2` (the engine's discs have unit
/// thickness there), mass over volume in space. Grains are counted from 1 as they stand, whatever their ids. A
/// packing in space has a right box from 0 on, periodic in all directions. Springs of contacts
/// (Packing::state) are not part of it.
std::string packing_data(const Packing& packing);

/// The rotation that turns the box of that file, whose first base vector is along x, into the laboratory.
Eigen::Matrix3d frame_of_packing_data(const Packing& packing);

}  // namespace polargrain
