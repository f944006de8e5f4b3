// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace LAMMPS_NS {
class Modify;
}

namespace polargrain::dem {

/// Adds the fixes of this folder to the engine's table: biaxial, grain/rotation, time_step/contacts.
void register_specimen_fixes(LAMMPS_NS::Modify& modify);

}  // namespace polargrain::dem
