// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "common/cell.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/cell/script_time_step.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

/// The words of a fix cell/load, of discs or of spheres; fix_cell_load.hpp gives their meaning.
struct CellLoadWords {
  CellControl control;
  MeanGrain mean_grain;  ///< a mass of 0: not given
  double turned = 0.0;   ///< rad
  std::optional<Eigen::Matrix3d> frame;
  std::string packing_state;  ///< file, or empty
};

/// Ends the process in the engine's words where they are wrong.
CellLoadWords read_cell_load_words(LAMMPS_NS::LAMMPS& lammps, int count, char** words);

/// Of the grains that the engine has. @param size of a grain by its radius: the area of a disc, the volume of a sphere
/// @param depth of that size, m: of discs the thickness, of spheres 1
MeanGrain mean_grain_of(LAMMPS_NS::Atom& atom, double (*size)(double radius), double depth);

/// The scales of a packing at rest, and the time step: the script's own where it is stable.
/// @param pressure that it carries; ends the process where it is not positive
void take_packing(LAMMPS_NS::LAMMPS& lammps, QuasiStatic& protocol, const MeanGrain& grain,
                  std::vector<Contact>& at_rest, double pressure, const ScriptTimeStep& time_step);

/// The bytes of a state in a file. Ends the process where it is missing.
StatePointer read_state_file(const std::string& file, LAMMPS_NS::Error& error);

}  // namespace polargrain::dem
