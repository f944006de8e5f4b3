// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>

#include "common/cell.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/spheres/space_box.hpp"

namespace polargrain::dem {

/// The words of a fix cell/load, of discs or of spheres; what they mean is said there (fix_cell_load.hpp).
struct CellLoadWords {
  CellControl control;
  MeanGrain mean_grain;  ///< a mass of 0: not given
  double turned = 0.0;   ///< rad
  std::optional<Eigen::Matrix3d> frame;
  std::string packing_state;  ///< file, or empty
};

/// Ends the process in the engine's words where they are wrong.
CellLoadWords read_cell_load_words(LAMMPS_NS::LAMMPS& lammps, int count, char** words);

/// The bytes of a state in a file. Ends the process where there is none.
StatePointer read_state_file(const std::string& file, LAMMPS_NS::Error& error);

}  // namespace polargrain::dem
