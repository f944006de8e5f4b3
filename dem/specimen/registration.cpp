// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/specimen/registration.hpp"

#include "dem/engine/private_access.hpp"
#include "dem/specimen/fix_biaxial.hpp"
#include "dem/specimen/fix_grain_rotation.hpp"
#include "dem/specimen/fix_time_step.hpp"

namespace polargrain::dem {

void register_specimen_fixes(LAMMPS_NS::Modify& modify) {
  using LAMMPS_NS::Fix;
  using LAMMPS_NS::LAMMPS;
  fix_table(modify)["biaxial"] = [](LAMMPS* lammps, int count, char** words) -> Fix* {
    return new FixBiaxial(lammps, count, words);
  };
  fix_table(modify)["grain/rotation"] = [](LAMMPS* lammps, int count, char** words) -> Fix* {
    return new FixGrainRotation(lammps, count, words);
  };
  fix_table(modify)["time_step/contacts"] = [](LAMMPS* lammps, int count, char** words) -> Fix* {
    return new FixTimeStep(lammps, count, words);
  };
}

}  // namespace polargrain::dem
